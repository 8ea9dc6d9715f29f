// skyshaft-models FOLDER: writes the models that come with Skyshaft, always the same bytes.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "data/generator/glb_writer.h"
#include "data/generator/models.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: skyshaft-models FOLDER\n", stderr);
    return 2;
  }
  try {
    for (const render::Model& model : {generator::make_pergola(), generator::make_plant(), generator::make_gate(),
                                       generator::make_bench(), generator::make_post()}) {
      const std::filesystem::path path = std::filesystem::path(argv[1]) / (model.name + ".glb");
      generator::write_glb(path, model);
      std::printf("%s: %zu triangles, %ju bytes\n", path.c_str(), model.triangle_count(),
                  static_cast<std::uintmax_t>(std::filesystem::file_size(path)));
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "skyshaft-models: %s\n", error.what());
    return 1;
  }
}
