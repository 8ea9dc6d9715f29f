#pragma once

#include <ostream>
#include <vector>

#include "render/sun/sun.h"

namespace app {

// One line of `skyshaft sun`: where the sun stands and what of its light arrives.
struct SunRow {
  render::UtcTime time;
  render::Place place;
  render::SunPosition position;
  render::SunLight light;
};

struct SunTableOptions {
  render::SunTier tier = render::SunTier::Precise;
  render::Weather weather;
  double turbidity = render::kClearTurbidity;
};

SunRow sun_row(const render::Place& place, render::UtcTime time, const SunTableOptions& options);

// The columns that a batch gets: azimuth_deg, elevation_deg, apparent_elevation_deg, illuminance_lux, r, g, b.
// r, g, b is illuminance_rgb in lux: linear Rec. 709 whose luminance is illuminance_lux.
void write_sun_csv(std::ostream& out, const std::vector<SunRow>& rows);
// Every figure, one object a row.
void write_sun_json(std::ostream& out, const std::vector<SunRow>& rows, const SunTableOptions& options);
// For people: one instant with the day's rise, transit and set; or a table.
void write_sun_text(std::ostream& out, const std::vector<SunRow>& rows, const SunTableOptions& options);

// Reads CSV with columns utc, lat_deg, lon_deg, height_m (others are ignored), writes those with the columns above.
// Throws ar::InputError that names file and line.
void run_sun_batch(std::istream& in, const std::string& name, std::ostream& out, const SunTableOptions& options);

}  // namespace app
