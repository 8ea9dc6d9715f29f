// Writes what the tables of scene keys give: the key reference of docs/scene-file.md, and data/scene.schema.json.
//   skyshaft-scene-docs SOURCE_FOLDER

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "app/scene_file/key_documents.h"

namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
  std::cout << file.string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: skyshaft-scene-docs SOURCE_FOLDER\n";
    return 2;
  }
  try {
    const fs::path root = argv[1];
    const fs::path document = root / "docs/scene-file.md";
    write(document, app::with_key_reference(read(document)));
    write(root / "data/scene.schema.json", app::scene_schema());
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
