#include "render/shafts/epipolar.h"

#include <algorithm>
#include <array>

namespace render {
namespace {

constexpr int kSamplesUnit = 1;
constexpr int kTreesUnit = 2;  // and two more
constexpr int kMapUnit = 8;
constexpr float kDepthTolerance = 0.02F;
constexpr double kCloseLinesPx = 1.0;

gl::Defines with(gl::Defines defines, const char* name) {
  defines.push_back({name});
  return defines;
}

}  // namespace

Epipolar::Epipolar(const LineSettings& settings, const gl::Defines& defines, bool sun_disc)
    : settings_(settings),
      sample_("shafts/line_samples.frag", defines, sun_disc, "shafts/line_places.vert"),
      between_(AirProgram::SkyAtCorners{}, "shafts/line_picture.frag"),
      alone_("shafts/line_picture.frag", with(defines, "ALONE"), sun_disc),
      open_(settings.divisor) {}

// Where lines lie that close, accuracy was asked for.
Epipolar::Epipolar(const LineSettings& settings)
    : Epipolar(settings, settings.line_px <= kCloseLinesPx ? gl::Defines{{"BOTH_SLICES"}} : gl::Defines{}, false) {}

Epipolar::Epipolar(const LineSettings& settings, const MarchSteps& steps)
    : Epipolar(settings, gl::Defines{{"LINE_MARCH"}}, steps.sun_disc) {
  steps_ = steps;
}

// For pixels up to `beside_px` beside their slices: the walk ends twice that before surfaces, for walls seen askew.
void Epipolar::bind(const gl::Program& program, const ShaftInputs& inputs, const LineLayout& layout,
                    double beside_px) const {
  layout.set(program);
  casters_.bind(program, inputs, kMapUnit);
  if (steps_) {
    steps_->set(program);
  } else {
    trees_.bind(program, kTreesUnit);
    const double px_rad = inputs.view.width / (inputs.view.focal_px.x * layout.picture_px.x);
    program.set("end_margin", static_cast<float>(std::min(2.0 * beside_px * px_rad, 0.5)));
  }
}

// Along the lines, with line_places.vert.
void Epipolar::draw_places(const gl::Program& program, const gl::Framebuffer& target, int more, int rows) const {
  program.set("half_size_px", 0.5F * glm::vec2(target.width(), target.height()));
  program.set("more", static_cast<float>(more));
  draw_row_groups(no_vertices_, rows);
}

void Epipolar::draw_samples(const ShaftInputs& inputs, const LineLayout& layout) {
  if (samples_.width() != layout.samples || samples_.height() < layout.rows) {
    const int rows = layout.rows;
    samples_ = gl::Texture(GL_RGBA32F, layout.samples, rows, gl::Filter::Nearest, 1, "samples on lines");
    pairs_ = gl::Texture(GL_RGBA32F, layout.samples - 1, rows, gl::Filter::Nearest, 1, "pairs of samples");
    to_samples_ = gl::Framebuffer({&samples_}, nullptr, "samples on lines");
    to_pairs_ = gl::Framebuffer({&pairs_}, nullptr, "pairs of samples");
  }
  to_samples_.bind();
  const gl::Program& sample = sample_.use(inputs, layout.picture_px);
  bind(sample, inputs, layout, 0.0);
  draw_places(sample, to_samples_, 2, layout.rows);
  to_pairs_.bind();
  const std::array<float, 4> tells_nothing{0.0F, 0.0F, 1e9F, 1e9F};  // line_pairs.frag
  glClearBufferfv(GL_COLOR, 0, tells_nothing.data());
  pair_.use();
  layout.set(pair_);
  pair_.set("samples", kSamplesUnit);
  pair_.set("samples_texel", 1.0F / glm::vec2(samples_.width(), samples_.height()));
  pair_.set("tolerance", static_cast<float>(settings_.tolerance));
  samples_.bind(kSamplesUnit);
  draw_places(pair_, to_pairs_, 1, layout.rows);
}

void Epipolar::draw_picture(const ShaftInputs& inputs, const LineLayout& layout) {
  const glm::ivec2 size_px = layout.picture_px;
  target_.begin(inputs, size_px);
  glEnable(GL_DEPTH_TEST);
  // What samples tell is drawn nearest, whatever is there; the rest before the farthest.
  const gl::Program& between = between_.use(inputs, size_px);
  layout.set(between);
  between.set("depth_tolerance", kDepthTolerance);
  between.set("pairs", kSamplesUnit);
  between.set("pairs_texel", 1.0F / glm::vec2(pairs_.width(), pairs_.height()));
  pairs_.bind(kSamplesUnit);
  glDepthFunc(GL_ALWAYS);
  glDepthRangef(0.0F, 0.0F);
  between_.draw();
  glDepthRangef(0.0F, 1.0F);
  glDepthFunc(GL_LESS);
  bind(alone_.use(inputs, size_px), inputs, layout, 0.5 * settings_.line_px);
  alone_.draw();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
}

const ShaftPicture& Epipolar::draw(const ShaftInputs& inputs) {
  casters_.update(inputs);
  if (casters_.empty()) return open_.draw(inputs);
  const glm::ivec2 size_px = shaft_size(inputs.view, settings_.divisor);
  const LineLayout layout = lay_out_lines(inputs, size_px, settings_.line_px, settings_.sample_px);
  plain_state();
  if (!steps_) trees_.update(inputs, casters_, layout);
  draw_samples(inputs, layout);
  draw_picture(inputs, layout);
  CasterMap::unbind(kMapUnit);
  alone_.release();
  return target_.picture();
}

}  // namespace render
