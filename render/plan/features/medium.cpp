#include <array>
#include <optional>

#include "render/composite/still_pass.h"
#include "render/gl/read_back.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"

namespace render::feature {
namespace {

// Objects that are not there, as deep as those that are.
class BareObjects {
 public:
  explicit BareObjects(const ObjectsPicture& real)
      : added_(GL_RGBA16F, real.width, real.height, gl::Filter::Nearest, 1, "no light"),
        multiplier_(GL_RGB10_A2, real.width, real.height, gl::Filter::Nearest, 1, "all kept"),
        picture_(real) {
    clear(added_, 0.0F);
    clear(multiplier_, 1.0F);
    picture_.added = added_.id();
    picture_.multiplier = multiplier_.id();
  }

  const ObjectsPicture& picture() const { return picture_; }

 private:
  static void clear(const gl::Texture& texture, float value) {
    const gl::Framebuffer target({&texture}, nullptr, "objects that are not there");
    target.bind();
    glDisable(GL_SCISSOR_TEST);
    const std::array<float, 4> color{value, value, value, 1.0F};
    glClearBufferfv(GL_COLOR, 0, color.data());
  }

  gl::Texture added_;
  gl::Texture multiplier_;
  ObjectsPicture picture_;
};

// Once before black, which leaves what the medium adds, and once before white, which tells what it lets through.
class MediumAlone final : public FeaturePass {
 public:
  static Decision needed(const PlanRequest& request) {
    if (request.target != Target::Medium) return NotNeeded{"it is seen together with the rest of the picture"};
    if (!request.needs.nothing_drawn.empty()) return nothing_drawn(request);
    if (!request.needs.medium) return NotNeeded{request.needs.no_shafts};
    return Needed{"as large as the picture", "the medium alone is asked for"};
  }

  void draw(Frame& frame) override {
    CompositeLayers layers = frame.layers();
    std::optional<BareObjects> bare;
    if (layers.objects != nullptr) layers.objects = &bare.emplace(*layers.objects).picture();
    // As bright as the light, so that nothing is rounded off.
    const auto white = static_cast<float>(1.0 / frame.scene.exposure);
    const LinearImage light = before(0.0F, layers, frame.scene.exposure);
    const LinearImage through = before(white, layers, frame.scene.exposure);
    MediumImage& medium = frame.medium;
    medium = {.width = light.width, .height = light.height, .rgba = {}, .axis_distance_m = {}};
    for (std::size_t i = 0; i < light.rgb.size(); ++i) {
      const glm::vec3 kept = (through.rgb[i] - light.rgb[i]) / white;
      medium.rgba.emplace_back(light.rgb[i], kept.g);
    }
    if (layers.shafts->width == medium.width && layers.shafts->height == medium.height) {
      medium.axis_distance_m = gl::read_red(layers.shafts->distance, medium.width, medium.height);
    }
  }

 private:
  // What is seen before a background of that luminance, with nothing but medium between.
  LinearImage before(float luminance, const CompositeLayers& layers, double exposure) {
    LinearImage plain{layers.view->width, layers.view->height, {}};
    plain.rgb.assign(static_cast<std::size_t>(plain.width) * static_cast<std::size_t>(plain.height),
                     glm::vec3(luminance));
    still_.set_background(plain);
    still_.draw(layers, exposure);
    return still_.read();
  }

  StillPass still_;
};

}  // namespace

constinit const Feature kMedium = feature_of<MediumAlone>("medium");

}  // namespace render::feature
