#pragma once

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "render/base/csv.h"

// Rows of a CSV table as maps from column name to text, "" where a row is short; empty where the file is absent.
inline std::vector<std::map<std::string, std::string>> read_table(const std::string& path) {
  std::vector<std::map<std::string, std::string>> rows;
  std::ifstream file(path);
  render::CsvRecords records(file);
  const auto names = records.next();
  while (const auto fields = records.next()) {
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < names->size(); ++i) row[(*names)[i]] = i < fields->size() ? (*fields)[i] : "";
    rows.push_back(row);
  }
  return rows;
}
