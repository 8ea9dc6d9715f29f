#include "app/tables/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "ar/error.h"
#include "render/base/number.h"

namespace app {

CsvReader::CsvReader(std::istream& in, std::string name, const std::vector<std::string>& required)
    : records_(in), name_(std::move(name)) {
  if (!read_record(header_)) throw ar::InputError(fmt::format("{}: empty; expected a CSV header", name_));
  for (const std::string& column : required) {
    if (has(column)) continue;
    throw ar::InputError(fmt::format("{}:1: no column `{}` in the header `{}`\nneeded: {}", name_, column,
                                     fmt::join(header_, ","), fmt::join(required, ",")));
  }
}

bool CsvReader::read_record(std::vector<std::string>& fields) {
  try {
    const auto record = records_.next();
    if (!record) return false;
    fields.clear();
    for (const std::string& field : *record) fields.emplace_back(render::trimmed(field));
    return true;
  } catch (const std::runtime_error& error) {
    throw ar::InputError(fmt::format("{}: {}", where(), error.what()));
  }
}

bool CsvReader::next() {
  if (!read_record(row_)) return false;
  if (row_.size() != header_.size()) {
    throw ar::InputError(fmt::format("{}: {} fields, but the header has {}", where(), row_.size(), header_.size()));
  }
  return true;
}

std::optional<std::size_t> CsvReader::index_of(const std::string& column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header_.begin());
}

const std::string& CsvReader::text(const std::string& column) const {
  const auto index = index_of(column);
  if (!index) throw std::logic_error("no CSV column " + column);
  return row_[*index];
}

double CsvReader::number(const std::string& column) const {
  const std::string& field = text(column);
  const std::optional<double> value = render::parse_number(field);
  if (!value) {
    throw ar::InputError(fmt::format("{}: `{}` is `{}`\nexpected a number", where(), column, field));
  }
  return *value;
}

std::optional<double> CsvReader::optional_number(const std::string& column) const {
  if (!has(column) || text(column).empty()) return std::nullopt;
  return number(column);
}

std::string CsvReader::where() const {
  return fmt::format("{}:{}", name_, records_.line());
}

}  // namespace app
