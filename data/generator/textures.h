#pragma once

#include <vector>

#include "render/scene/model.h"

namespace generator {

// All textures are made by formula. Base colours are sRGB; normal maps are glTF's (+x right, +y up in the picture).

// Planed larch: base colour, normal and roughness; WoodSheet (timber.h) says how it is laid out.
std::vector<render::Image> wood_textures();

// Base colour and normal, tileable: terracotta (1 tile = 0.5 m), garden soil (0.3 m), granite (0.4 m), bark (0.25 m).
std::vector<render::Image> terracotta_textures();
std::vector<render::Image> soil_textures();
std::vector<render::Image> granite_textures();
std::vector<render::Image> bark_textures();

// Four sprigs of lemon leaves, one in each quarter, growing upwards from the middle of its lower edge; with alpha.
render::Image leaf_texture();

}  // namespace generator
