#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "render/scene/model.h"

namespace render {

// Linear picture, row 0 at the top.
struct LinearImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> rgb;  // width * height
};

// Files appear whole: written beside the final name, then renamed. Throw std::runtime_error that names the file.
void write_exr(const std::filesystem::path& path, const LinearImage& image);  // 32-bit float
LinearImage read_exr(const std::filesystem::path& path);
LinearImage read_hdr(const std::filesystem::path& path);  // Radiance RGBE
void write_png(const std::filesystem::path& path, const Image& image);
Image read_png(const std::filesystem::path& path);

}  // namespace render
