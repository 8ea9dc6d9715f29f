#pragma once

#include <ostream>

#include "render/daylight/average_light.h"

namespace app {

// Text: the totals and the ten bins that give most. CSV: every bin. JSON: both.
void write_average_text(std::ostream& out, const render::AverageLight& light);
void write_average_csv(std::ostream& out, const render::AverageLight& light);
void write_average_json(std::ostream& out, const render::AverageLight& light);

}  // namespace app
