#pragma once

#include <algorithm>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace render {

// The records of a CSV text (RFC 4180: fields in quotes may hold commas, line breaks and doubled quotes; lines end with
// LF or CR LF). A byte order mark is skipped, and so are lines with nothing but blanks. Fields are as they are written,
// blanks included.
class CsvRecords {
 public:
  explicit CsvRecords(std::istream& in) : in_(in) {}

  // The next one, or nothing at the end. Throws std::runtime_error where a quoted field is never closed.
  std::optional<std::vector<std::string>> next() {
    std::string record;
    std::string line;
    while (std::getline(in_, line)) {
      if (++read_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
      if (line.ends_with('\r')) line.pop_back();
      if (record.empty()) line_ = read_;
      record += (record.empty() ? "" : "\n") + line;
      if (std::count(record.begin(), record.end(), '"') % 2 == 1) continue;
      if (record.find_first_not_of(" \t") != std::string::npos) return fields_of(record);
      record.clear();
    }
    if (!record.empty()) throw std::runtime_error("a quoted field is never closed");
    return std::nullopt;
  }
  // Where the last one began, counted from 1.
  int line() const { return line_; }

 private:
  static std::vector<std::string> fields_of(const std::string& record) {
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
    return fields;
  }

  std::istream& in_;
  int read_ = 0;  // lines
  int line_ = 0;
};

}  // namespace render
