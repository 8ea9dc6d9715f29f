#pragma once

#include <optional>

#include "render/scene/gltf/document.h"
#include "render/scene/gltf/material.h"
#include "render/scene/model.h"

namespace render::gltf {

// A primitive as triangles in its mesh's own frame, with unit normals and tangents (computed where the file has none),
// texture coordinates as `source` asks. Nothing for points and lines. Throws std::runtime_error on indices beyond the
// vertices and on positions that are not finite. `where` names the primitive.
std::optional<Mesh> read_primitive(const Document& document, const Json& primitive, const MaterialSource& source,
                                   const std::string& where);

}  // namespace render::gltf
