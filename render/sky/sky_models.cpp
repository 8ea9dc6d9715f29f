#include "render/sky/sky_models.h"

#include <algorithm>

#include "render/sky/sky_model_list.h"

namespace render {
namespace {

class BlackSky final : public SkyModel {
 public:
  glm::dvec3 luminance_rgb(const glm::dvec3&) const override { return glm::dvec3(0.0); }
};

}  // namespace

SkyModelInfo black_model() {
  return {.written = "none",
          .words = {"none"},
          .summary = "Black: no sky light, neither clouds nor night.",
          .make = [](const SkyOptions&, const SunPosition&) { return std::make_unique<BlackSky>(); }};
}

bool SkyModelInfo::is_named_by(const std::string& word) const {
  return prefix.empty() ? word == written : word.starts_with(prefix);
}

const std::vector<SkyModelInfo>& sky_models() {
  static const std::vector<SkyModelInfo> models = [] {
    std::vector<SkyModelInfo> all;
    for (const auto& model : kSkyModels) all.push_back(model());
    return all;
  }();
  return models;
}

const SkyModelInfo* find_sky_model(const std::string& word) {
  const auto& models = sky_models();
  const auto found =
      std::find_if(models.begin(), models.end(), [&](const SkyModelInfo& model) { return model.is_named_by(word); });
  return found == models.end() ? nullptr : &*found;
}

std::string known_sky_models() {
  std::string words;
  for (const SkyModelInfo& model : sky_models()) {
    if (!words.empty()) words += &model == &sky_models().back() ? " or " : ", ";
    words += model.written;
  }
  return words;
}

}  // namespace render
