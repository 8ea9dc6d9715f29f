#include "ar/track/tag_face.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "ar/track/tag_family.h"

namespace ar {

namespace {

// Debian's library does not export image_u8_destroy; the picture is two blocks of malloc.
struct FreePicture {
  void operator()(image_u8_t* picture) const {
    std::free(picture->buf);
    std::free(picture);
  }
};
using Picture = std::unique_ptr<image_u8_t, FreePicture>;

}  // namespace

int tag_count(const std::string& family) {
  return static_cast<int>(make_family(family)->ncodes);
}

TagFace make_tag_face(const std::string& family, int id, double size_m) {
  const FamilyPtr code = make_family(family);
  if (id < 0 || id >= static_cast<int>(code->ncodes))
    throw std::runtime_error(fmt::format("{} has no tag {}; accepted: 0 to {}", family, id, code->ncodes - 1));
  const Picture image(apriltag_to_image(code.get(), static_cast<uint32_t>(id)));
  TagFace face;
  face.cells = image->width + 2;
  face.cell_m = size_m / code->width_at_border;
  face.white.assign(static_cast<std::size_t>(face.cells) * static_cast<std::size_t>(face.cells), 1);
  for (int y = 0; y < image->height; ++y) {
    for (int x = 0; x < image->width; ++x) {
      face.white[static_cast<std::size_t>((y + 1) * face.cells + x + 1)] =
          image->buf[y * image->stride + x] > 127 ? 1 : 0;
    }
  }
  return face;
}

bool TagFace::is_white(double x, double y) const {
  const double half = 0.5 * cells;
  const int column = std::clamp(static_cast<int>(std::floor(x / cell_m + half)), 0, cells - 1);
  const int row = std::clamp(static_cast<int>(std::floor(y / cell_m + half)), 0, cells - 1);
  return white[static_cast<std::size_t>(row * cells + column)] != 0;
}

}  // namespace ar
