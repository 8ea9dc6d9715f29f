#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace render {

// A picture or texture, 8 bits a channel, row 0 at the top (glTF's v = 0).
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // width * height * 4
};

// Linear picture, row 0 at the top.
struct LinearImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> rgb;  // width * height
};

}  // namespace render
