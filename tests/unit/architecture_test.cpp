// The edges that DESIGN.md section 1 forbids, checked on the sources themselves.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Rule {
  std::string folder;     // sources below it ...
  std::string forbidden;  // ... never include a header that this matches
};

const std::vector<Rule> kRules{
    {"render", R"((ar|calib|app)/.*)"},
    {"render", R"((opencv2|opencv)/.*|lib(av|sw)[a-z]+/.*)"},
    {"ar", R"((render|calib|app)/.*)"},
    {"calib", R"((render|app)/.*)"},
    {"render/sun", R"(render/(?!sun/).*)"},
    {"render/sky", R"(render/(?!sun/|sky/|medium/|scene/image_io\.h|scene/model\.h).*|(EGL|GLES[23]?)/.*)"},
    {"render/medium", R"(render/(?!medium/).*|(EGL|GLES[23]?)/.*)"},
    {"render/gl", R"(render/(?!gl/).*)"},
};

std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> found;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, include)) found.push_back(match[1]);
  }
  return found;
}

bool is_source(const fs::path& path) {
  return path.extension() == ".cpp" || path.extension() == ".h";
}

TEST(Architecture, NoForbiddenInclude) {
  const fs::path root = SKYSHAFT_SOURCE_DIR;
  int files = 0;
  for (const Rule& rule : kRules) {
    const std::regex forbidden(rule.forbidden);
    for (const auto& entry : fs::recursive_directory_iterator(root / rule.folder)) {
      if (!is_source(entry.path())) continue;
      ++files;
      for (const std::string& include : includes_of(entry.path())) {
        EXPECT_FALSE(std::regex_match(include, forbidden)) << fs::relative(entry.path(), root) << " includes "
                                                           << include << ", which " << rule.folder << "/ must not know";
      }
    }
  }
  EXPECT_GT(files, 50) << "the walk saw too few sources to mean anything";
}

TEST(Architecture, RootHoldsOnlyWhatTheDesignNames) {
  const std::vector<std::string> allowed{"CMakeLists.txt",
                                         "CMakePresets.json",
                                         "dev",
                                         "README.md",
                                         "LICENSE",
                                         "CHANGELOG.md",
                                         "CONTRIBUTING.md",
                                         "findings",
                                         "app",
                                         "ar",
                                         "render",
                                         "shaders",
                                         "calib",
                                         "tests",
                                         "data",
                                         "docs",
                                         "build",
                                         "demo"};
  for (const auto& entry : fs::directory_iterator(SKYSHAFT_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    EXPECT_NE(std::find(allowed.begin(), allowed.end(), name), allowed.end()) << name << " does not belong in the root";
  }
}

}  // namespace
