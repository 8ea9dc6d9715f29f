#include "render/shafts/epipolar.h"

namespace render {
namespace {

constexpr int kSamplesUnit = 1;
constexpr int kTreesUnit = 2;  // and two more
constexpr int kMapUnit = 8;
constexpr float kDepthTolerance = 0.02F;

}  // namespace

Epipolar::Epipolar(const LineSettings& settings, const gl::Defines& defines)
    : settings_(settings),
      sample_("shafts/line_samples.frag", defines),
      picture_("shafts/line_picture.frag", defines),
      open_(settings.divisor) {}

Epipolar::Epipolar(const LineSettings& settings) : Epipolar(settings, gl::Defines{}) {}

Epipolar::Epipolar(const LineSettings& settings, const MarchSteps& steps)
    : Epipolar(settings, gl::Defines{{"LINE_MARCH"}}) {
  steps_ = steps;
}

void Epipolar::bind(const gl::Program& program, const ShaftInputs& inputs, const LineLayout& layout) const {
  layout.set(program);
  casters_.bind(program, inputs, kMapUnit);
  if (steps_) {
    steps_->set(program);
  } else {
    trees_.bind(program, kTreesUnit);
  }
}

void Epipolar::draw_samples(const ShaftInputs& inputs, const LineLayout& layout) {
  const int width = layout.places + 1;
  if (samples_.width() != width || samples_.height() < layout.rows) {
    samples_ = gl::Texture(GL_RG32F, width, layout.rows, gl::Filter::Nearest, 1, "samples on lines");
    to_samples_ = gl::Framebuffer({&samples_}, nullptr, "samples on lines");
  }
  to_samples_.bind();
  confine_to({0, 0, width, layout.rows});
  bind(sample_.use(inputs, layout.picture_px), inputs, layout);
  gl::draw_full_screen(no_vertices_);
}

const ShaftPicture& Epipolar::draw(const ShaftInputs& inputs) {
  casters_.update(inputs);
  if (casters_.empty()) return open_.draw(inputs);
  const glm::ivec2 size_px = shaft_size(inputs.view, settings_.divisor);
  const LineLayout layout = lay_out_lines(inputs, size_px, settings_.line_px, settings_.sample_px);
  plain_state();
  if (!steps_) trees_.update(inputs, casters_, layout);
  draw_samples(inputs, layout);
  target_.begin(inputs, size_px);
  const gl::Program& picture = picture_.use(inputs, size_px);
  bind(picture, inputs, layout);
  picture.set("tolerance", static_cast<float>(settings_.tolerance));
  picture.set("depth_tolerance", kDepthTolerance);
  picture.set("samples", kSamplesUnit);
  samples_.bind(kSamplesUnit);
  gl::draw_full_screen(no_vertices_);
  CasterMap::unbind(kMapUnit);
  glDisable(GL_SCISSOR_TEST);
  return target_.picture();
}

}  // namespace render
