#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/shafts/shaft_settings.h"

namespace render {

// What `skyshaft trade` measured of one setting over the standard scenes.
struct ShaftMeasurement {
  std::string settings;           // as parse_shaft_settings() reads it
  double relative_rmse = 0.0;     // of the in-scattered light, on the scene where it is largest
  double ms_per_megapixel = 0.0;  // of the shaft pass, on the scene where it takes longest
};

// The table that comes with Skyshaft (data/shaft_table.csv). Settings that this version no longer knows are left out.
const std::vector<ShaftMeasurement>& shaft_table();

// Reads such a table: a header with at least the columns width, height, settings, shafts_ms and relative_rmse, then a
// line for each scene and setting; a field that holds commas is quoted. Settings that are missing on some scene count
// by the others. Throws std::runtime_error that says what is wrong with it.
std::vector<ShaftMeasurement> read_shaft_table(const std::string& csv);

// What a user asks of the shafts instead of naming a technique.
struct ShaftDemand {
  std::optional<double> max_error;  // relative RMSE that must hold
  std::optional<double> target_ms;  // that the shaft pass may take
};

// With max_error the cheapest setting known to hold it, or the most accurate where none does; with target_ms the most
// accurate known to fit, or the cheapest; with both, the cheapest that holds the error among those that fit, else the
// most accurate of those. nullopt where nothing is demanded or known. For medium that occluders shade: never
// closed-form, whose light no shaft is cut out of, however little time there is.
std::optional<ShaftSettings> choose_shafts(const std::vector<ShaftMeasurement>& table, const ShaftDemand& demand,
                                           double pixels);

}  // namespace render
