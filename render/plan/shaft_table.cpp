#include "render/plan/shaft_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "render/base/csv.h"
#include "render/base/number.h"
#include "render/plan/embedded_shaft_table.h"

namespace render {
namespace {

std::size_t column(const std::vector<std::string>& header, const std::string& name) {
  const auto found = std::ranges::find(header, name);
  if (found == header.end()) throw std::runtime_error(fmt::format("the table of shafts has no column '{}'", name));
  return static_cast<std::size_t>(found - header.begin());
}

double number(const std::string& text, int line) {
  const std::optional<double> value = parse_number(text);
  if (!value) {
    throw std::runtime_error(fmt::format("the table of shafts, line {}: found '{}'; accepted: a number", line, text));
  }
  return *value;
}

bool is_known(const std::string& settings) {
  try {
    parse_shaft_settings(settings);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

// The first by `key`, or null where there is none.
template <typename Key>
const ShaftMeasurement* least(const std::vector<const ShaftMeasurement*>& among, Key&& key) {
  const auto found = std::ranges::min_element(among, {}, [&](const ShaftMeasurement* m) { return key(*m); });
  return found == among.end() ? nullptr : *found;
}

std::vector<const ShaftMeasurement*> those(const std::vector<const ShaftMeasurement*>& among, auto&& wanted) {
  std::vector<const ShaftMeasurement*> out;
  std::ranges::copy_if(among, std::back_inserter(out), [&](const ShaftMeasurement* m) { return wanted(*m); });
  return out;
}

}  // namespace

std::vector<ShaftMeasurement> read_shaft_table(const std::string& csv) {
  std::istringstream in(csv);
  CsvRecords records(in);
  const std::vector<std::string> header = records.next().value_or(std::vector<std::string>());
  const std::size_t width = column(header, "width");
  const std::size_t height = column(header, "height");
  const std::size_t settings = column(header, "settings");
  const std::size_t ms = column(header, "shafts_ms");
  const std::size_t error = column(header, "relative_rmse");
  std::map<std::string, ShaftMeasurement> worst;
  while (const auto record = records.next()) {
    const std::vector<std::string>& fields = *record;
    const int at = records.line();
    if (fields.size() != header.size()) {
      throw std::runtime_error(
          fmt::format("the table of shafts, line {}: found {} fields; accepted: {}", at, fields.size(), header.size()));
    }
    ShaftMeasurement& entry = worst[fields[settings]];
    entry.settings = fields[settings];
    const double megapixels = 1e-6 * number(fields[width], at) * number(fields[height], at);
    entry.ms_per_megapixel = std::max(entry.ms_per_megapixel, number(fields[ms], at) / megapixels);
    entry.relative_rmse = std::max(entry.relative_rmse, number(fields[error], at));
  }
  std::vector<ShaftMeasurement> table;
  for (auto& [name, entry] : worst) table.push_back(std::move(entry));
  return table;
}

const std::vector<ShaftMeasurement>& shaft_table() {
  static const std::vector<ShaftMeasurement> table = [] {
    std::vector<ShaftMeasurement> all = read_shaft_table(std::string(kEmbeddedShaftTable));
    std::erase_if(all, [](const ShaftMeasurement& m) { return !is_known(m.settings); });
    return all;
  }();
  return table;
}

std::optional<ShaftSettings> choose_shafts(const std::vector<ShaftMeasurement>& table, const ShaftDemand& demand,
                                           double pixels) {
  if ((!demand.max_error && !demand.target_ms) || table.empty()) return std::nullopt;
  const auto time = [](const ShaftMeasurement& m) { return m.ms_per_megapixel; };
  const auto error = [](const ShaftMeasurement& m) { return m.relative_rmse; };
  std::vector<const ShaftMeasurement*> among;
  for (const ShaftMeasurement& m : table) {
    if (!m.settings.starts_with("closed-form")) among.push_back(&m);
  }
  if (among.empty()) return std::nullopt;
  if (demand.target_ms) {
    const auto fits = [&](const ShaftMeasurement& m) {
      return m.ms_per_megapixel * 1e-6 * pixels <= *demand.target_ms;
    };
    const std::vector<const ShaftMeasurement*> fitting = those(among, fits);
    if (fitting.empty()) return parse_shaft_settings(least(among, time)->settings);
    among = fitting;
  }
  if (demand.max_error) {
    const auto holds = [&](const ShaftMeasurement& m) { return m.relative_rmse <= *demand.max_error; };
    const ShaftMeasurement* cheapest = least(those(among, holds), time);
    if (cheapest != nullptr) return parse_shaft_settings(cheapest->settings);
  }
  return parse_shaft_settings(least(among, error)->settings);
}

}  // namespace render
