#include "render/shafts/epipolar/epipolar.h"

#include <algorithm>
#include <array>

namespace render {
namespace {

constexpr float kDepthTolerance = 0.02F;
constexpr double kCloseLinesPx = 1.0;

gl::Defines with(gl::Defines defines, const char* name) {
  defines.push_back({name});
  return defines;
}

}  // namespace

Epipolar::Epipolar(const LineSettings& settings, const gl::Defines& defines, bool sun_disc)
    : settings_(settings),
      sample_("shafts/epipolar_samples.frag", defines, sun_disc, "shafts/epipolar_samples.vert"),
      between_(MediumProgram::SkyAtCorners{}, "shafts/epipolar_picture.frag"),
      alone_("shafts/epipolar_picture.frag", with(defines, "ALONE"), sun_disc),
      open_(settings.divisor) {}

// Where lines lie that close, accuracy was asked for.
Epipolar::Epipolar(const LineSettings& settings)
    : Epipolar(settings, settings.line_px <= kCloseLinesPx ? gl::Defines{{"BOTH_SLICES"}} : gl::Defines{}, false) {}

Epipolar::Epipolar(const LineSettings& settings, const MarchSteps& steps)
    : Epipolar(settings, gl::Defines{{"LINE_MARCH"}}, steps.sun_disc) {
  steps_ = steps;
}

// For pixels up to `beside_px` beside their slices: the traversal ends twice that before surfaces, for walls seen
// askew.
void Epipolar::bind(const gl::Program& program, const CascadeOccluders& occluders, const ShaftInputs& inputs,
                    const LineLayout& layout, double beside_px) const {
  layout.set(program);
  occluders.map.bind(program, inputs);
  if (steps_) {
    steps_->set(program);
  } else {
    occluders.trees.bind(program);
    const double px_rad = inputs.view.width / (inputs.view.focal_px.x * layout.picture_px.x);
    program.set("end_margin", static_cast<float>(std::min(2.0 * beside_px * px_rad, 0.5)));
  }
}

// Along the lines, with epipolar_samples.vert.
void Epipolar::draw_samples_at(const gl::Program& program, const gl::Framebuffer& target, int more, int rows) const {
  program.set("half_size_px", 0.5F * glm::vec2(target.width(), target.height()));
  program.set("more", static_cast<float>(more));
  draw_row_groups(no_vertices_, rows);
}

void Epipolar::make_storage(const LineLayout& layout) {
  if (samples_.width() == layout.samples && samples_.height() >= layout.rows) return;
  const int rows = layout.rows;
  samples_ = gl::Texture(GL_RGBA32F, layout.samples, rows, gl::Filter::Nearest, 1, "samples on lines");
  pairs_ = gl::Texture(GL_RGBA32F, layout.samples - 1, rows, gl::Filter::Nearest, 1, "pairs of samples");
  to_samples_ = gl::Framebuffer({&samples_}, nullptr, "samples on lines");
  to_pairs_ = gl::Framebuffer({&pairs_}, nullptr, "pairs of samples");
}

void Epipolar::draw_samples(const ShaftInputs& inputs, std::span<const Cascade> parts, const LineLayout& layout) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!steps_) occluders_[i].trees.update(inputs, occluders_[i].map, layout);
    add_up(i);
    to_samples_.bind();
    const gl::Program& sample = sample_.use(inputs, layout.picture_px, parts[i].range);
    bind(sample, occluders_[i], inputs, layout, 0.0);
    draw_samples_at(sample, to_samples_, 2, layout.rows);
  }
  plain_state();
}

void Epipolar::draw_pairs(const LineLayout& layout) {
  to_pairs_.bind();
  const std::array<float, 4> tells_nothing{0.0F, 0.0F, 1e9F, 1e9F};  // epipolar_pairs.frag
  glClearBufferfv(GL_COLOR, 0, tells_nothing.data());
  pair_.use();
  layout.set(pair_);
  pair_.bind("samples", samples_.handle());
  pair_.set("samples_texel", 1.0F / glm::vec2(samples_.width(), samples_.height()));
  pair_.set("tolerance", static_cast<float>(settings_.tolerance));
  draw_samples_at(pair_, to_pairs_, 1, layout.rows);
}

// What samples tell is drawn nearest, whatever is there; the rest before the farthest.
void Epipolar::draw_between(const ShaftInputs& inputs, const LineLayout& layout) {
  const gl::Program& between = between_.use(inputs, layout.picture_px);
  layout.set(between);
  between.set("depth_tolerance", kDepthTolerance);
  between.bind("pairs", pairs_.handle());
  between.set("pairs_texel", 1.0F / glm::vec2(pairs_.width(), pairs_.height()));
  glDepthFunc(GL_ALWAYS);
  glDepthRangef(0.0F, 0.0F);
  between_.draw();
  glDepthRangef(0.0F, 1.0F);
}

void Epipolar::draw_alone(const ShaftInputs& inputs, std::span<const Cascade> parts, const LineLayout& layout) {
  glDepthFunc(GL_LESS);
  glDepthMask(GL_FALSE);  // all parts are of the same pixels
  for (std::size_t i = 0; i < parts.size(); ++i) {
    add_up(i);
    bind(alone_.use(inputs, layout.picture_px, parts[i].range), occluders_[i], inputs, layout, 0.5 * settings_.line_px);
    alone_.draw();
  }
  glDepthMask(GL_TRUE);
  plain_state();
}

const ShaftPicture& Epipolar::draw(const ShaftInputs& inputs) {
  const std::vector<Cascade> parts = inputs.parts();
  while (occluders_.size() < parts.size()) occluders_.emplace_back();
  for (std::size_t i = 0; i < parts.size(); ++i) occluders_[i].map.update(inputs, *parts[i].maps);
  if (occluders_.front().map.empty()) return open_.draw(inputs);
  const glm::ivec2 size_px = shaft_size(inputs.view, settings_.divisor);
  const LineLayout layout = lay_out_lines(inputs, size_px, settings_.line_px, settings_.sample_px);
  plain_state();
  make_storage(layout);
  draw_samples(inputs, parts, layout);
  draw_pairs(layout);
  target_.begin(inputs, size_px);
  glEnable(GL_DEPTH_TEST);
  draw_between(inputs, layout);
  draw_alone(inputs, parts, layout);
  return target_.picture();
}

}  // namespace render
