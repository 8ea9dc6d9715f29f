#pragma once

#include "render/base/rectangle.h"
#include "render/medium/medium.h"
#include "render/scene/view.h"

namespace render {

// The part of the view in which a medium can be seen: everything for an unbounded one, or where the box reaches behind
// the near plane; else the rectangle around its projection, clipped to the picture (empty where it is out of view).
PixelRect medium_region(const View& view, const Medium& medium);

}  // namespace render
