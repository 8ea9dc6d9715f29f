#include "app/tables/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "ar/error.h"

namespace app {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool quote_is_open(const std::string& text) {
  return std::count(text.begin(), text.end(), '"') % 2 == 1;
}

std::vector<std::string> split(const std::string& record) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < record.size(); ++i) {
    const char c = record[i];
    if (c == '"' && quoted && i + 1 < record.size() && record[i + 1] == '"') {
      fields.back() += record[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  std::transform(fields.begin(), fields.end(), fields.begin(), trimmed);
  return fields;
}

}  // namespace

CsvReader::CsvReader(std::istream& in, std::string name, const std::vector<std::string>& required)
    : in_(in), name_(std::move(name)) {
  if (!read_record(header_)) throw ar::InputError(fmt::format("{}: empty; expected a CSV header", name_));
  if (header_.front().starts_with("\xEF\xBB\xBF")) header_.front().erase(0, 3);
  for (const std::string& column : required) {
    if (has(column)) continue;
    throw ar::InputError(fmt::format("{}:1: no column `{}` in the header `{}`\nneeded: {}", name_, column,
                                     fmt::join(header_, ","), fmt::join(required, ",")));
  }
}

bool CsvReader::read_record(std::vector<std::string>& fields) {
  std::string record;
  std::string line;
  while (std::getline(in_, line)) {
    ++line_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (record.empty()) record_line_ = line_;
    record += (record.empty() ? "" : "\n") + line;
    if (quote_is_open(record)) continue;
    if (trimmed(record).empty()) {
      record.clear();
      continue;
    }
    fields = split(record);
    return true;
  }
  if (!record.empty()) throw ar::InputError(fmt::format("{}: a quoted field is never closed", where()));
  return false;
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
  const char* first = field.c_str() + (field.starts_with('+') ? 1 : 0);
  const char* last = field.c_str() + field.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) {
    throw ar::InputError(fmt::format("{}: `{}` is `{}`\nexpected a number", where(), column, field));
  }
  return value;
}

std::optional<double> CsvReader::optional_number(const std::string& column) const {
  if (!has(column) || text(column).empty()) return std::nullopt;
  return number(column);
}

std::string CsvReader::where() const {
  return fmt::format("{}:{}", name_, record_line_);
}

}  // namespace app
