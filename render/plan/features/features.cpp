#include "render/plan/features/features.h"

#include <array>

namespace render {

std::span<const Feature* const> features() {
  using namespace feature;
  static constexpr std::array kInOrder{&kBackground, &kShadow, &kObjects,   &kCascades, &kShafts, &kTranslucency,
                                       &kMedium,     &kUpload, &kComposite, &kMerge,    &kRead,   &kOverlay};
  return kInOrder;
}

}  // namespace render
