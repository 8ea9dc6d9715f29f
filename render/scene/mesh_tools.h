#pragma once

#include "render/scene/model.h"

namespace render {

// Sets bounds_min and bounds_max from all vertices; both 0 when there is none.
void update_bounds(Model& model);

// Gives every corner its own vertex with its triangle's normal, as glTF asks where normals are missing.
void make_flat_normals(Mesh& mesh);

// Makes normals unit length; those that cannot be (zero, NaN) become the area-weighted mean of the faces around.
void repair_normals(Mesh& mesh);

// Tangents from texture coordinates: per triangle the gradient of u, summed at each vertex and made orthogonal to the
// normal [Lengyel 2001]; vertices between mirrored and unmirrored faces are split. Any unit tangent where the texture
// coordinates are degenerate.
void make_tangents(Mesh& mesh);

// Makes tangents unit length, orthogonal to the normal, with handedness +1 or -1. Requires unit normals.
void repair_tangents(Mesh& mesh);

}  // namespace render
