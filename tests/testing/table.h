#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

// Rows of a plain CSV table (no quotes) as maps from column name to text; empty where the file is absent.
inline std::vector<std::map<std::string, std::string>> read_table(const std::string& path) {
  std::vector<std::map<std::string, std::string>> rows;
  std::ifstream file(path);
  std::string line;
  const auto next_line = [&] {
    if (!std::getline(file, line)) return false;
    if (line.ends_with('\r')) line.pop_back();
    return true;
  };
  next_line();
  std::vector<std::string> names;
  std::stringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  while (next_line()) {
    std::stringstream stream(line);
    std::map<std::string, std::string> row;
    std::string text;
    for (const std::string& name : names) row[name] = std::getline(stream, text, ',') ? text : "";
    rows.push_back(row);
  }
  return rows;
}
