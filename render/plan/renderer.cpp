#include "render/plan/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "render/composite/composite_pass.h"
#include "render/composite/display_image.h"
#include "render/gl/label.h"
#include "render/plan/features/features.h"
#include "render/plan/frame.h"
#include "render/plan/frame_view.h"
#include "render/plan/pass_clock.h"

namespace render {
namespace {

void expect(Target target, const Plan& plan, const char* caller) {
  if (plan.target != target) throw std::logic_error(fmt::format("{}: the plan is for another target", caller));
}

// Pre-exposure of a still, whose luminances are divided by it again: half floats hold them, whatever exposure the
// picture is shown at, where white paper is 1, and light scattered straight on from the sun at most 20,000.
double still_exposure(const SceneState& scene) {
  const Sun& sun = sun_of(scene);
  const auto brightest = [](const glm::dvec3& rgb) { return std::max({rgb.r, rgb.g, rgb.b}); };
  const double white = (brightest(sun.illuminance_rgb) * std::max(sun.direction_in_world.z, 0.0) +
                        brightest(scene.sky_light.horizontal_illuminance_rgb)) /
                       std::numbers::pi;
  double most = std::max(white, 1e-3 * brightest(sun.illuminance_rgb));
  if (scene.medium) {
    const Medium& medium = *scene.medium;
    const double peak = phase(medium.phase_function, medium.g, medium.g < 0.0 ? -1.0 : 1.0);
    most = std::max(most, brightest(sun.illuminance_rgb) * peak * std::max(medium.shaft_gain, 1.0) / 20000.0);
  }
  return most > 0.0 ? 1.0 / most : scene.exposure;
}

}  // namespace

struct Renderer::Impl {
  GpuModels models;
  FrameView view;
  std::optional<SunShadow> unshadowed;  // for plans without the shadow pass
  std::map<const Feature*, std::unique_ptr<FeaturePass>> made;
  std::optional<ShaftError> shafts_error;
  PassClock clock;

  FeaturePass& pass_of(const Feature& feature) {
    std::unique_ptr<FeaturePass>& pass = made[&feature];
    if (!pass) pass = feature.make();
    return *pass;
  }

  Frame frame_of(const SceneState& scene, const Plan& plan) {
    if (!unshadowed && !plan.has(feature::kShadow)) unshadowed.emplace();
    const View& ideal = view.update(scene.camera, plan.target == Target::Video ? plan.quality.render_scale : 1.0);
    return {.scene = scene,
            .plan = plan,
            .models = models,
            .view = ideal,
            .lens = view.lens(),
            .shadow = unshadowed ? &*unshadowed : nullptr};
  }

  void run(Frame& frame) {
    clock.begin_frame();
    for (const Pass& pass : frame.plan.passes) pass_of(*pass.feature).prepare(frame.plan);
    for (const Pass& pass : frame.plan.passes) {
      const gl::DebugGroup group(pass.feature->name);
      clock.time(pass.feature->name, [&] { pass_of(*pass.feature).draw(frame); });
    }
    shafts_error = frame.shafts_error;
    models.forget_unused();
  }
};

Renderer::Renderer(gl::Context& context) {
  context.make_current();
  impl_ = std::make_unique<Impl>();
}

Renderer::~Renderer() = default;

void Renderer::composite(const SceneState& scene, const Plan& plan, const PictureView& in,
                         const MutablePictureView& out) {
  expect(Target::Video, plan, "composite");
  if (in.format != out.format) throw std::logic_error("composite: the pictures' formats differ");
  if (plan.passes.empty()) {
    impl_->clock.begin_frame();
    return copy_picture(in, out);
  }
  if (in.format.width != scene.camera.width || in.format.height != scene.camera.height) {
    throw std::runtime_error(fmt::format("the picture is {} x {} pixels, the camera's is {} x {}", in.format.width,
                                         in.format.height, scene.camera.width, scene.camera.height));
  }
  Frame frame = impl_->frame_of(scene, plan);
  frame.in = &in;
  frame.out = &out;
  impl_->run(frame);
}

LinearImage Renderer::render_linear(const SceneState& scene, const Plan& plan) {
  expect(Target::Still, plan, "render_linear");
  SceneState exposed = scene;
  exposed.exposure = still_exposure(scene);
  Frame frame = impl_->frame_of(exposed, plan);
  impl_->run(frame);
  return std::move(frame.linear);
}

MediumImage Renderer::render_medium(const SceneState& scene, const Plan& plan) {
  expect(Target::Medium, plan, "render_medium");
  if (!plan.has(feature::kMedium)) throw std::logic_error("render_medium: the plan has no medium");
  SceneState exposed = scene;
  exposed.exposure = still_exposure(scene);
  Frame frame = impl_->frame_of(exposed, plan);
  impl_->run(frame);
  return std::move(frame.medium);
}

std::optional<ShaftError> Renderer::shafts_error() const {
  return impl_->shafts_error;
}

Image Renderer::display_image(const LinearImage& linear, double exposure) const {
  return render::display_image(linear, exposure);
}

void Renderer::enable_timing(bool on) {
  impl_->clock.enable(on);
}
const std::vector<PassTime>& Renderer::pass_times() const {
  return impl_->clock.times();
}

}  // namespace render
