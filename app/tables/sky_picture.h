#pragma once

#include <filesystem>
#include <optional>

#include "app/tables/sky_request.h"
#include "render/images/image_io.h"

namespace app {

enum class SkyProjection {
  Fisheye,  // equidistant, the zenith in the middle, north up, east to the left as one sees it lying on the back
  LatLong,  // zenith in the top row, north in the middle, azimuth growing to the right; the ground is black
  Cube      // render::make_sky_cube() over ground of albedo 0.2: a row of six faces for each roughness
};

struct SkyPictureOptions {
  SkyProjection projection = SkyProjection::Fisheye;
  // Default 512; the width follows: the same for a fisheye, twice that for lat-long. Of a cube the largest faces'
  // height, default 64.
  std::optional<int> height_px;
  bool sun_disc = true;
  std::optional<double> exposure;  // display white per cd/m2 in PNG; absent: fitted to the picture
};

// Luminance in cd/m2, linear Rec. 709. Throws UsageError for a size that a cube cannot have.
render::LinearImage sky_picture(const render::Daylight& answer, const SkyPictureOptions& options);

// Writes .exr or .hdr (cd/m2) or .png (tone-mapped). Throws UsageError for any other ending.
void write_sky_picture(const std::filesystem::path& path, const render::Daylight& answer,
                       const SkyPictureOptions& options);

}  // namespace app
