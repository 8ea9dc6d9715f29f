#include "render/shafts/march/march.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace render {

gl::Defines MarchSteps::defines() const {
  return {{"SPACING", std::to_string(spacing)}};
}

void MarchSteps::set(const gl::Program& program) const {
  program.set("steps", count);
  program.set("near_steps", std::clamp(static_cast<int>(std::lround(count * near_share)), 0, count - 1));
  program.set("near_way_m", near_share > 0.0 ? static_cast<float>(near_m) : 0.0F);
}

const ShaftPicture& March::draw(const ShaftInputs& inputs) {
  const std::vector<Cascade> parts = inputs.parts();
  while (occluders_.size() < parts.size()) occluders_.emplace_back(1);
  for (std::size_t i = 0; i < parts.size(); ++i) occluders_[i].update(inputs, *parts[i].maps);
  if (occluders_.front().empty()) return open_.draw(inputs);
  const glm::ivec2 size_px = shaft_size(inputs.view, divisor_);
  target_.begin(inputs, size_px);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    add_up(i);
    const gl::Program& march = march_.use(inputs, size_px, parts[i].range);
    steps_.set(march);
    occluders_[i].bind(march, inputs);
    march_.draw();
  }
  plain_state();
  return target_.picture();
}

}  // namespace render
