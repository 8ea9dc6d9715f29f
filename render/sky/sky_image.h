#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "render/images/image_io.h"
#include "render/sky/sky_model.h"

namespace render {

// Lat-long (equirectangular) pictures of the sky: row 0 is the zenith's side, the middle column looks north, azimuth
// grows to the right. Directions of pixel centres.
glm::dvec3 lat_long_direction(double column_px, double row_px, int width, int height);

// The sun as a lat-long picture shows it.
struct PicturedSun {
  glm::dvec3 direction_in_picture{0.0};
  glm::dvec3 irradiance_rgb{0.0};  // on a plane facing it, in the picture's unit times steradian
};

// A picture of the sky without its sun.
struct SkyImage {
  LinearImage sky;
  std::optional<PicturedSun> sun;  // absent where no disc stands out, or it was clipped
};

// Finds the disc (the brightest spot that outshines its surroundings at least 30 times), measures what it adds to them
// and paints it over with them, so that its light is not counted twice. Throws std::invalid_argument for a picture
// that is not twice as wide as high.
SkyImage separate_sun(LinearImage picture);

// Reads `file` (.exr or .hdr), turns it about the vertical so that its sun, if it shows one, stands at the azimuth of
// `sun`, and scales it so that sun and sky together give level ground the illuminance of a clear day with the sun at
// the pictured elevation; without a pictured sun, so that the sky alone gives `diffuse_lux`. A picture without light
// stays black. Throws std::runtime_error that names the file and what is wrong with it.
std::unique_ptr<SkyModel> make_image_sky(const std::filesystem::path& file, const SunPosition& sun, double diffuse_lux);

}  // namespace render
