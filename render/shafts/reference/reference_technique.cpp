#include "render/shafts/reference/reference_technique.h"

#include <spdlog/spdlog.h>

#include <array>
#include <chrono>

#include "render/gl/read_back.h"

namespace render {
namespace {

class ProgressLog {
 public:
  explicit ProgressLog(int rows) : rows_(rows) {}

  void operator()(int done) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::seconds(5)) return;
    last_ = now;
    spdlog::info("reference: {} of {} rows", done, rows_);
  }

 private:
  int rows_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

ShaftTechniqueInfo reference() {
  return {.name = "reference",
          .summary = "the truth: on the CPU, exact shadow boundaries, error-controlled; slow",
          .parameters = {{.name = "sky",
                          .meaning = "sky light: hidden by what stands before it, taken whole, or left out",
                          .choices = {"traced", "open", "none"}},
                         {.name = "max_error",
                          .meaning = "relative, of the sampling of the sun's disc and of the sky",
                          .low = 1e-5,
                          .high = 0.1,
                          .default_value = 2e-3}},
          .presets = {},
          .make = [](const ShaftSettings& s) -> std::unique_ptr<ShaftTechnique> {
            constexpr std::array kSkies{ReferenceSky::Traced, ReferenceSky::Open, ReferenceSky::None};
            ReferenceSettings settings;
            settings.sky = kSkies.at(static_cast<std::size_t>(s.integer("sky")));
            settings.max_error = s.number("max_error");
            return std::make_unique<ReferenceTechnique>(settings);
          },
          .handles_translucency = true};
}

}  // namespace

const ShaftPicture& ReferenceTechnique::draw(const ShaftInputs& inputs) {
  ShaftInputs asked = inputs;
  asked.with_distance = true;
  const ShaftPicture& distances = closed_form_.draw(asked);
  const ShaftReference truth(inputs.scene, settings_);
  ReferencePicture result =
      truth.picture(inputs.view, gl::read_red(distances.distance, distances.width, distances.height),
                    ProgressLog(inputs.view.height));
  error_ = ShaftError{.mean = result.mean_error, .largest = result.largest_error};
  const auto exposure = static_cast<float>(inputs.scene.exposure);
  for (glm::vec4& pixel : result.rgba) pixel = glm::vec4(exposure * glm::vec3(pixel), pixel.a);
  if (scattered_.width() != result.width || scattered_.height() != result.height) {
    scattered_ = gl::Texture(GL_RGBA32F, result.width, result.height, gl::Filter::Nearest, 1, "reference");
  }
  scattered_.upload(GL_RGBA, GL_FLOAT, result.rgba.data());
  picture_ = {
      .texture = scattered_.id(), .distance = distances.distance, .width = result.width, .height = result.height};
  return picture_;
}

void add_shaft_reference() {
  add_shaft_technique(reference());
}

}  // namespace render
