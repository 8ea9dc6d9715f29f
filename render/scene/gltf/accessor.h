#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/scene/gltf/document.h"

namespace render::gltf {

// All elements of a vector or scalar accessor as floats, `components` apiece: integers scaled to [0, 1] or [-1, 1]
// where `normalized`, sparse replacements applied. Throws std::runtime_error when its type has another number of
// components or anything lies outside its buffer view.
std::vector<float> read_floats(const Document& document, std::size_t accessor, std::size_t components);

// A scalar accessor of unsigned integers: a primitive's indices.
std::vector<std::uint32_t> read_indices(const Document& document, std::size_t accessor);

}  // namespace render::gltf
