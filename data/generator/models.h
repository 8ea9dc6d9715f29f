#pragma once

#include "render/scene/model.h"

// The models of data/models, in the world's axes (z up, -y glTF's forward), metres, each with its origin on the ground
// under its middle.
namespace generator {

// Timber pergola: 3.2 x 3.2 m, 2.5 m high; a roof of laths with gaps that carve light, a slatted wall on its west side.
render::Model make_pergola();

// A lemon tree in a terracotta pot, 1.5 m high.
render::Model make_plant();

// A garden gate of upright laths between two posts, 1.6 m wide, 1.7 m high; its opening looks south and north.
render::Model make_gate();

// A garden bench, 1.5 m long, facing south.
render::Model make_bench();

// A bare vertical post of 0.1 x 0.1 x 2 m with sharp edges: 12 triangles. Its shadow tells the sun's direction.
render::Model make_post();

}  // namespace generator
