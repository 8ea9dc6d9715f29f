// The house as docs/architecture.md has it, checked on the sources themselves: who may include whom.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/testing/sources.h"

namespace {

using namespace sources;

// From the bottom up: a file includes only what its own room or one above it in this list has. A room is a folder with
// those below it that are not listed themselves.
const std::vector<std::string> kRooms{"render/base",
                                      "render/images",
                                      "render/sun",
                                      "render/medium",
                                      "render/sky",
                                      "render/daylight",
                                      "render/scene",
                                      "render/gl",
                                      "render/visibility",
                                      "render/shadow",
                                      "render/surface",
                                      "render/shafts",
                                      "render/composite",
                                      "render/plan",
                                      "render/compare",
                                      "ar",
                                      "ar/place",
                                      "ar/capture",
                                      "ar/capture/color",
                                      "ar/capture/file",
                                      "ar/output",
                                      "ar/capture/live",
                                      "ar/capture/v4l2",
                                      "ar/capture/libcamera",
                                      "ar/capture/devices",
                                      "ar/output/v4l2",
                                      "ar/track",
                                      "ar/photometry",
                                      "calib/files",
                                      "calib/boards",
                                      "calib/solve",
                                      "calib/verdict",
                                      "calib/views",
                                      "calib/tagmap",
                                      "app",
                                      "app/options",
                                      "app/pipeline",
                                      "app/scene_file",
                                      "app/tools",
                                      "app/report",
                                      "app/tables",
                                      "app/process",
                                      "app/window",
                                      "app/live",
                                      "app/calibration",
                                      "app/trade",
                                      "app/synth",
                                      "app/cmd",
                                      "app/main.cpp"};

struct Rule {
  std::string room;       // sources in it and below it ...
  std::string forbidden;  // ... never include a header that this matches
};

// What the order alone does not say.
const std::vector<Rule> kRules{
    {"render", R"((ar|calib|app)/.*)"},
    {"render", R"((opencv2|opencv)/.*|lib(av|sw)[a-z]+/.*)"},
    {"render/base", R"((EGL|GLES[23]?)/.*)"},
    {"render/images", R"((EGL|GLES[23]?)/.*)"},
    {"render/sun", R"((EGL|GLES[23]?)/.*)"},
    {"render/medium", R"((EGL|GLES[23]?)/.*)"},
    {"render/sky", R"((EGL|GLES[23]?)/.*)"},
    {"render/scene", R"((EGL|GLES[23]?)/.*)"},
    {"ar", R"((render/(?!base/)|calib/|app/).*)"},
    {"calib", R"((render/(?!base/)|app/).*)"},
};

std::vector<std::string> includes_of(const std::string& file) {
  static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> found;
  std::istringstream in(text_of(root() / file));
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, include)) found.push_back(match[1]);
  }
  return found;
}

bool lies_in(const std::string& file, const std::string& room) {
  return file == room || file.starts_with(room + "/");
}

// Index of the innermost room that holds a file, or -1.
int room_of(const std::string& file) {
  int found = -1;
  for (std::size_t i = 0; i < kRooms.size(); ++i) {
    const bool holds = lies_in(file, kRooms[i]);
    if (holds && (found < 0 || kRooms[i].size() > kRooms[static_cast<std::size_t>(found)].size())) {
      found = static_cast<int>(i);
    }
  }
  return found;
}

TEST(Architecture, NobodyIncludesUpwards) {
  const std::vector<std::string> files = sources_below({"render", "ar", "calib", "app"}, is_cpp);
  for (const std::string& file : files) {
    const int room = room_of(file);
    ASSERT_GE(room, 0) << file << " lies in no room of the list";
    for (const std::string& include : includes_of(file)) {
      const int other = room_of(include);
      EXPECT_LE(other, room) << file << " includes " << include << ", which stands above "
                             << kRooms[static_cast<std::size_t>(room)];
    }
  }
  EXPECT_GT(files.size(), 400U) << "the walk saw too few sources to mean anything";
}

TEST(Architecture, NoForbiddenInclude) {
  for (const Rule& rule : kRules) {
    const std::regex forbidden(rule.forbidden);
    for (const std::string& file : sources_below({rule.room}, is_cpp)) {
      for (const std::string& include : includes_of(file)) {
        EXPECT_FALSE(std::regex_match(include, forbidden))
            << file << " includes " << include << ", which " << rule.room << "/ must not know";
      }
    }
  }
}

TEST(Architecture, RootHoldsOnlyWhatTheDesignNames) {
  const std::vector<std::string> allowed{"CMakeLists.txt",
                                         "CMakePresets.json",
                                         "dev",
                                         "README.md",
                                         "CONTRIBUTING.md",
                                         "LICENSE",
                                         "CHANGELOG.md",
                                         "app",
                                         "ar",
                                         "render",
                                         "shaders",
                                         "calib",
                                         "tests",
                                         "data",
                                         "docs",
                                         "findings",
                                         "build",
                                         "demo"};
  for (const auto& entry : std::filesystem::directory_iterator(root())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    EXPECT_NE(std::find(allowed.begin(), allowed.end(), name), allowed.end()) << name << " does not belong in the root";
  }
}

}  // namespace
