// skyshaft-bench-scenes FOLDER: writes the standard scenes, always the same bytes.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "data/generator/glb_writer.h"
#include "render/base/whole_file.h"
#include "tests/bench/scenes/scenes.h"

namespace {

void write_scene(const std::filesystem::path& folder, const render::Model& model, const std::string& yaml) {
  generator::write_glb(folder / (model.name + ".glb"), model);
  render::write_file_whole(folder / (model.name + ".yaml"), render::Bytes(yaml.begin(), yaml.end()));
  std::printf("%s: %zu triangles\n", (folder / (model.name + ".yaml")).c_str(), model.triangle_count());
}

}  // namespace

int main(int argc, char** argv) {
  using bench_scenes::Detail;
  if (argc != 2) {
    std::fputs("usage: skyshaft-bench-scenes FOLDER\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const Detail detail : {Detail::Coarse, Detail::Fine}) {
      const render::Model forest = bench_scenes::make_forest(detail);
      write_scene(folder, forest, bench_scenes::forest_yaml(forest.name));
      const render::Model gate = bench_scenes::make_gate(detail);
      write_scene(folder, gate, bench_scenes::gate_yaml(gate.name));
    }
    const render::Model room = bench_scenes::make_room();
    write_scene(folder, room, bench_scenes::room_yaml(room.name));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "skyshaft-bench-scenes: %s\n", error.what());
    return 1;
  }
}
