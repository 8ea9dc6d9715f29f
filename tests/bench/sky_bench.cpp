// Accuracy and cost of sun and sky. Prints the tables of docs/measurements/sky.md, or puts them there:
//   bench_sky [--write DOCS]
// DOCS/measurements/sky.md has a place for each table, between <!-- bench:NAME --> and <!-- /bench -->; plots go to
// DOCS/images.

#include "tests/bench/sky_bench.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

// The page with a table put in its place.
std::string with_table(const std::string& page, const std::string& name, const std::string& table) {
  const std::string opening = "<!-- bench:" + name + " -->\n";
  const std::size_t begin = page.find(opening);
  const std::size_t end = page.find("<!-- /bench -->", begin);
  if (begin == std::string::npos || end == std::string::npos) {
    throw std::runtime_error("no place for the table `" + name + "`: expected " + opening);
  }
  return page.substr(0, begin + opening.size()) + table + page.substr(end);
}

void put_in_place(const bench::Report& report, const std::filesystem::path& docs) {
  const std::filesystem::path file = docs / "measurements" / "sky.md";
  std::ifstream in(file, std::ios::binary);
  std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [name, table] : report.tables) page = with_table(page, name, table);
  write(file, page);
  for (const auto& [name, svg] : report.plots) write(docs / "images" / name, svg);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    bench::Report report;
    bench::measure_sun(report);
    bench::measure_models(report);
    bench::measure_levels(report);
    bench::measure_patches(report);
    for (const auto& [name, table] : report.tables) fmt::print("{}\n\n{}\n", name, table);
    if (argc == 3 && std::string(argv[1]) == "--write") put_in_place(report, argv[2]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_sky: {}\n", error.what());
    return 1;
  }
}
