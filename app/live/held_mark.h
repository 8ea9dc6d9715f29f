#pragma once

#include "ar/output/sink.h"

namespace app {

// Draws a frame of slanting black and white stripes along the picture's edges: it stands still. Only brightness is
// touched (all planes of RGB pictures).
void mark_as_held(ar::OutputFrame& frame);

}  // namespace app
