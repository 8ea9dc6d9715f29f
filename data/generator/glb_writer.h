#pragma once

#include <filesystem>

#include "render/scene/model.h"

namespace generator {

// Writes `model` as one .glb with embedded textures, world axes turned into glTF's. Tangents are left out: every reader
// makes them from the texture coordinates. Throws std::runtime_error that names the file.
void write_glb(const std::filesystem::path& path, const render::Model& model);

}  // namespace generator
