#include "ar/track/tag_face.h"

#include <fmt/format.h>

extern "C" {
#include <apriltag.h>
#include <tag16h5.h>
#include <tag25h9.h>
#include <tag36h11.h>
#include <tagCircle21h7.h>
#include <tagStandard41h12.h>
#include <tagStandard52h13.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace ar {

namespace {

struct FamilyCode {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array<FamilyCode, 6> kFamilies{{
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag16h5", tag16h5_create, tag16h5_destroy},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
    {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
}};

using Family = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

// Debian's library does not export image_u8_destroy; the picture is two blocks of malloc.
struct FreePicture {
  void operator()(image_u8_t* picture) const {
    std::free(picture->buf);
    std::free(picture);
  }
};
using Picture = std::unique_ptr<image_u8_t, FreePicture>;

Family open_family(const std::string& name) {
  const auto* const code =
      std::find_if(kFamilies.begin(), kFamilies.end(), [&](const FamilyCode& f) { return name == f.name; });
  if (code == kFamilies.end()) throw std::runtime_error("unknown tag family " + name);
  return {code->create(), code->destroy};
}

}  // namespace

int tag_count(const std::string& family) {
  return static_cast<int>(open_family(family)->ncodes);
}

TagFace make_tag_face(const std::string& family, int id, double size_m) {
  const Family code = open_family(family);
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
