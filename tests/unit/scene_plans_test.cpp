// The plans of the scenes that come with the project.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <vector>

#include "app/process/still.h"
#include "render/plan/features/features.h"
#include "render/plan/plan.h"

namespace app {
namespace {

constexpr std::array kTargets{render::Target::Video, render::Target::Still, render::Target::Medium};

std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SKYSHAFT_SOURCE_DIR "/data/scenes")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

Still still_of(const std::filesystem::path& scene) {
  StillArguments arguments;
  arguments.scene = scene;
  return make_still(arguments);
}

// `feature` is that many times among the passes and omissions, each time with its reason.
int mentions(const render::Plan& plan, const render::Feature& feature) {
  int count = 0;
  for (const render::Pass& pass : plan.passes) {
    if (pass.feature == &feature && !pass.reason.empty() && !pass.settings.empty()) ++count;
  }
  for (const render::Omission& omission : plan.omitted) {
    if (omission.feature == &feature && !omission.reason.empty()) ++count;
  }
  return count;
}

TEST(ScenePlans, AccountForEachFeatureOnce) {
  const std::vector<std::filesystem::path> files = scene_files();
  EXPECT_GE(files.size(), 10U);
  for (const std::filesystem::path& file : files) {
    Still still = still_of(file);
    for (const render::Target target : kTargets) {
      for (const double scale : {1.0, 0.5}) {
        still.scene.quality.render_scale = scale;
        const render::Plan plan = render::make_plan(still.state, still.scene.quality, target);
        EXPECT_EQ(plan.passes.size() + plan.omitted.size(), render::features().size()) << file;
        for (const render::Feature* feature : render::features()) {
          EXPECT_EQ(mentions(plan, *feature), 1) << feature->name << " in " << file;
        }
      }
    }
  }
}

TEST(ScenePlans, RunPassesInTheOrderOfTheFeatures) {
  for (const std::filesystem::path& file : scene_files()) {
    const Still still = still_of(file);
    for (const render::Target target : kTargets) {
      const render::Plan plan = render::make_plan(still.state, still.scene.quality, target);
      auto at = render::features().begin();
      for (const render::Pass& pass : plan.passes) {
        at = std::find(at, render::features().end(), pass.feature);
        ASSERT_NE(at, render::features().end()) << pass.feature->name << " in " << file;
      }
    }
  }
}

}  // namespace
}  // namespace app
