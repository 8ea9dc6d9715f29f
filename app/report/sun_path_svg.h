#pragma once

#include <ostream>

#include "render/sun/sun.h"

namespace app {

// Sun-path diagram as an SVG page: north up, zenith in the middle, horizon on the rim, apparent elevation falling
// linearly outwards. The day of `time` with its hours (UTC), or with `whole_year` a path for the 21st of every month of
// that year and a loop (analemma) for each hour.
void write_sun_path_svg(std::ostream& out, const render::Place& place, render::UtcTime time, bool whole_year,
                        render::SunTier tier);

}  // namespace app
