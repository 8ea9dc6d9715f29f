#pragma once

#include <string>

#include "render/scene/model.h"

namespace app {

// The picture at most that wide, every pixel the mean of those it stands for.
render::Image thumbnail(const render::Image& image, int widest_px = 320);

// "data:image/jpeg;base64,...": the picture as a page holds it.
std::string data_uri(const render::Image& image);

}  // namespace app
