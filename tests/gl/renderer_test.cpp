// The renderer runs what the plan says, and nothing else.

#include "render/plan/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/process/still.h"
#include "render/plan/features/features.h"
#include "tests/testing/light_rig.h"

namespace app {
namespace {

using render::Plan;
using render::Target;

render::Renderer& renderer() {
  static render::Renderer instance(render::test::rig().context);
  return instance;
}

// Planar RGB of that grey.
class GreyPicture {
 public:
  GreyPicture(int width, int height, std::uint8_t grey)
      : format_{.width = width,
                .height = height,
                .chroma = render::Chroma::C444,
                .matrix = render::ColorMatrix::Rgb,
                .range = render::ColorRange::Full},
        samples_(static_cast<std::size_t>(3 * width * height), grey) {}

  render::PictureView view() const {
    render::PictureView view{.format = format_};
    for (std::size_t p = 0; p < 3; ++p) {
      view.plane[p] = samples_.data() + p * samples_.size() / 3;
      view.stride_bytes[p] = format_.width;
    }
    return view;
  }
  render::MutablePictureView mutable_view() {
    render::MutablePictureView view{.format = format_};
    for (std::size_t p = 0; p < 3; ++p) {
      view.plane[p] = samples_.data() + p * samples_.size() / 3;
      view.stride_bytes[p] = format_.width;
    }
    return view;
  }
  const std::vector<std::uint8_t>& samples() const { return samples_; }

 private:
  render::PictureFormat format_;
  std::vector<std::uint8_t> samples_;
};

std::vector<std::string> planned(const Plan& plan) {
  std::vector<std::string> names;
  for (const render::Pass& pass : plan.passes) names.emplace_back(pass.feature->name);
  return names;
}

std::vector<std::string> timed() {
  std::vector<std::string> names;
  for (const render::PassTime& pass : renderer().pass_times()) names.push_back(pass.name);
  return names;
}

// Those of the project's scenes that a still can be seen of, in a small picture.
std::vector<Still> small_stills() {
  std::vector<Still> stills;
  for (const auto& entry : std::filesystem::directory_iterator(SKYSHAFT_SOURCE_DIR "/data/scenes")) {
    if (entry.path().extension() != ".yaml") continue;
    StillArguments arguments;
    arguments.scene = entry.path();
    arguments.size = "96x64";
    Still still = make_still(arguments);
    still.scene.quality.shadow_map_size = 256;
    if (still.scene.view) stills.push_back(std::move(still));
  }
  return stills;
}

TEST(Renderer, TimesThePassesOfThePlanInItsOrder) {
  renderer().enable_timing(true);
  int pictures = 0;
  for (const Still& still : small_stills()) {
    SCOPED_TRACE(still.scene.path);
    const auto plan_for = [&](Target target, double scale = 1.0) {
      render::Quality quality = still.scene.quality;
      quality.render_scale = scale;
      return render::make_plan(still.state, quality, target);
    };
    const Plan of_still = plan_for(Target::Still);
    renderer().render_linear(still.state, of_still);
    EXPECT_EQ(timed(), planned(of_still));
    if (const Plan of_medium = plan_for(Target::Medium); of_medium.has(render::feature::kMedium)) {
      renderer().render_medium(still.state, of_medium);
      EXPECT_EQ(timed(), planned(of_medium));
    }
    for (const double scale : {1.0, 0.5}) {
      const GreyPicture in(96, 64, 100);
      GreyPicture out(96, 64, 0);
      const Plan of_video = plan_for(Target::Video, scale);
      renderer().composite(still.state, of_video, in.view(), out.mutable_view());
      EXPECT_EQ(timed(), planned(of_video));
      EXPECT_EQ(out.samples() == in.samples(), of_video.passes.empty());
    }
    ++pictures;
  }
  renderer().enable_timing(false);
  EXPECT_GE(pictures, 8);
}

// A pane's tint is a pass of its own.
TEST(Renderer, TintsShaftsOnlyByThePlan) {
  render::SceneState scene = render::test::sunny(200.0, 60.0, 0.0);
  render::Model pane = render::make_box({2.0, 2.0, 0.01});
  for (render::Material& material : pane.materials) {
    material.base_color = {0.9F, 0.2F, 0.1F, 0.5F};
    material.alpha_mode = render::AlphaMode::Blend;
  }
  scene.instances = {render::test::place(std::move(pane), {0.0, 0.0, 2.5}, false)};
  scene.camera = render::test::look_at(96, 64, {0.0, -7.0, 1.8}, {0.3, 0.0, 1.3}, 45.0);
  scene.medium.emplace();
  scene.medium->extinction_per_m = 0.08;
  const Plan tinted = render::make_plan(scene, {}, Target::Medium);
  ASSERT_TRUE(tinted.has(render::feature::kTranslucency));
  Plan untinted = tinted;
  std::erase_if(untinted.passes,
                [](const render::Pass& pass) { return pass.feature == &render::feature::kTranslucency; });
  const render::LinearImage red = renderer().render_medium(scene, tinted).in_scattered();
  const render::LinearImage grey = renderer().render_medium(scene, untinted).in_scattered();
  glm::dvec3 red_sum(0.0);
  glm::dvec3 grey_sum(0.0);
  for (std::size_t i = 0; i < red.rgb.size(); ++i) {
    red_sum += red.rgb[i];
    grey_sum += grey.rgb[i];
  }
  EXPECT_LT(red_sum.b / red_sum.r, 0.999 * grey_sum.b / grey_sum.r);
}

// Half floats end at 65504, which times an exposure for the night is little luminance by day.
TEST(Renderer, AStillsLuminanceDoesNotDependOnTheExposureItIsShownAt) {
  render::SceneState scene = render::test::sunny(200.0, 30.0, 0.0);
  scene.instances = {render::test::place(render::make_box({1.0, 1.0, 2.0}), {0.0, 0.0, 1.0}, false)};
  scene.camera = render::test::look_at(64, 48, {0.0, -7.0, 1.8}, {0.3, 0.0, 1.3}, 45.0);
  scene.medium.emplace();
  scene.medium->extinction_per_m = 0.08;
  const Plan plan = render::make_plan(scene, {}, Target::Still);
  scene.exposure = 1.0 / 20000.0;
  const render::LinearImage by_day = renderer().render_linear(scene, plan);
  for (const double exposure : {1e-12, 53.0, 1e6}) {  // 53: EV100 of -6
    scene.exposure = exposure;
    const render::LinearImage same = renderer().render_linear(scene, plan);
    for (std::size_t i = 0; i < same.rgb.size(); ++i) {
      ASSERT_EQ(same.rgb[i], by_day.rgb[i]) << "exposure " << exposure << ", pixel " << i;
    }
  }
}

// Its timer tells a fraction of what passes take.
TEST(Renderer, TakesNoGlTimesOfASoftwareRasteriser) {
  if (!render::test::rig().context.is_software()) GTEST_SKIP() << "drawn by a GPU";
  renderer().enable_timing(true);
  const Still still = std::move(small_stills().front());
  renderer().render_linear(still.state, render::make_plan(still.state, {}, Target::Still));
  for (const render::PassTime& pass : renderer().pass_times()) {
    EXPECT_EQ(pass.gpu_ms, 0.0) << pass.name;
    EXPECT_GT(pass.wall_ms, 0.0) << pass.name;
  }
  renderer().enable_timing(false);
}

TEST(Renderer, RefusesAPlanForAnotherTarget) {
  const Still still = std::move(small_stills().front());
  const Plan of_still = render::make_plan(still.state, {}, Target::Still);
  EXPECT_THROW(renderer().render_medium(still.state, of_still), std::logic_error);
  EXPECT_THROW(renderer().render_linear(still.state, render::make_plan(still.state, {}, Target::Video)),
               std::logic_error);
}

}  // namespace
}  // namespace app
