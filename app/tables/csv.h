#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "render/base/csv.h"

namespace app {

// Reads a CSV file with a header (RFC 4180: quoted fields, doubled quotes; CR LF or LF; a byte order mark is skipped).
class CsvReader {
 public:
  // Throws ar::InputError that names `name` when there is no header, or a column of `required` is missing.
  CsvReader(std::istream& in, std::string name, const std::vector<std::string>& required);

  // Goes to the next row; false at the end. Empty lines are skipped. Throws ar::InputError that names file and line
  // when a row has more or fewer fields than the header.
  bool next();

  bool has(const std::string& column) const { return index_of(column).has_value(); }
  // Text of a column that exists.
  const std::string& text(const std::string& column) const;
  // Number in a column; throws ar::InputError that names file, line, column and what was found.
  double number(const std::string& column) const;
  // Number in a column that may be absent or empty.
  std::optional<double> optional_number(const std::string& column) const;
  // "file:line", for messages.
  std::string where() const;

 private:
  std::optional<std::size_t> index_of(const std::string& column) const;
  bool read_record(std::vector<std::string>& fields);

  render::CsvRecords records_;
  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::string> row_;
};

}  // namespace app
