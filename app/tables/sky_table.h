#pragma once

#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "app/tables/sky_request.h"

namespace app {

// How a luminance is printed.
enum class ColorSpace { Xyz, Yxy, Rgb };

// Illuminances of level ground and the luminance in each direction.
void write_sky_text(std::ostream& out, const render::Daylight& answer, const std::vector<ViewRequest>& views,
                    ColorSpace space);
void write_sky_csv(std::ostream& out, const render::Daylight& answer, const std::vector<ViewRequest>& views,
                   ColorSpace space);
void write_sky_json(std::ostream& out, const render::Daylight& answer, const std::vector<ViewRequest>& views,
                    ColorSpace space);

// Reads CSV with columns utc, lat_deg, lon_deg, view_azimuth_deg, view_elevation_deg and, where present and not empty,
// turbidity, dni_wm2, dhi_wm2, epsilon, delta, sun_elevation_deg, sun_azimuth_deg. Writes those of them that are there
// and X, Y, Z in cd/m2 and sun_angle_deg. Columns go before `options`. Throws ar::InputError that names file and line.
void run_sky_batch(std::istream& in, const std::string& name, std::ostream& out, const render::SkyOptions& options);

}  // namespace app
