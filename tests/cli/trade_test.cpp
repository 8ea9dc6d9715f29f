// The reference and the trade of accuracy against speed, as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/testing/run_program.h"

namespace cli {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// A beam across hazy air, on the ground.
const std::string kBeam =
    "skyshaft: 1\n"
    "sky: none\n"
    "medium: { extinction: 0.2, extent: { box: [[-3, -3, 0], [3, 3, 3]] } }\n"
    "real: [ { plane: ground }, { box: { size: [0.6, 4, 0.3], position: [0, 0, 2] } } ]\n"
    "objects: [ { model: " SKYSHAFT_SOURCE_DIR
    "/data/models/post.glb, position: [-1, 0, 0] } ]\n"
    "exposure: { white_luminance: 8000 }\n"
    "view: { eye: [0.5, -5, 1.2], target: [0, 0, 1], vertical_fov_deg: 45 }\n"
    "sun: { azimuth_deg: 100, elevation_deg: 40, illuminance_lux: 80000, angular_radius_deg: 0 }\n";

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

// The number in a CSV line's n-th field, of a line whose fifth field is quoted and holds commas.
double field(const std::string& line, int after_quotes) {
  std::istringstream rest(line.substr(line.rfind('"') + 2));
  std::string value;
  for (int i = 0; i <= after_quotes; ++i) std::getline(rest, value, ',');
  return std::stod(value);
}

TEST(Trade, WritesATableAndAPageOfWhatItMeasured) {
  const Folder folder;
  const std::string scene = folder.write("beam.yaml", kBeam);
  const Result result =
      skyshaft({"-q", "trade", "--scene", scene, "-o", folder.path("out"), "--size", "96x64", "--frames", "1",
                "--setting", "closed-form:divisor=1", "--setting", "march:steps=32", "--setting", "march:steps=1024"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::istringstream csv(text_of(folder.path("out/trade.csv")));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4U);
  constexpr int kRelativeRmse = 3;
  EXPECT_GT(field(lines[1], kRelativeRmse), 2.0 * field(lines[2], kRelativeRmse));
  EXPECT_GT(field(lines[2], kRelativeRmse), 2.0 * field(lines[3], kRelativeRmse));
  EXPECT_LT(field(lines[3], kRelativeRmse), 0.02);  // what is left is the shadow map's texels
  const std::string page = text_of(folder.path("out/trade.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("<svg"), HasSubstr("data:image/jpeg;base64,"), HasSubstr("march:steps=1024")));
  EXPECT_THAT(page, Not(HasSubstr("http")));  // nothing is fetched
  EXPECT_FALSE(text_of(folder.path("out/truth.exr")).empty());
  EXPECT_FALSE(text_of(folder.path("out/transmittance.exr")).empty());
}

TEST(Trade, SaysWhatIsWrong) {
  const Folder folder;
  const std::string scene = folder.write("beam.yaml", kBeam);
  const Result setting = skyshaft({"trade", "--scene", scene, "-o", folder.path("out"), "--setting", "march:stepz=3"});
  EXPECT_EQ(setting.status, 2);
  EXPECT_THAT(setting.err, AllOf(HasSubstr("--setting"), HasSubstr("stepz")));
  std::string clear = kBeam;
  clear.replace(clear.find("medium:"), clear.find("real:") - clear.find("medium:"), "");
  const Result airless = skyshaft({"trade", "--scene", folder.write("clear.yaml", clear), "-o", folder.path("out")});
  EXPECT_EQ(airless.status, 1);
  EXPECT_THAT(airless.err, HasSubstr("medium"));
}

TEST(Render, TheReferenceReportsItsError) {
  const Folder folder;
  std::string soft = kBeam;
  soft.replace(soft.find("angular_radius_deg: 0"), 21, "angular_radius_deg: 1");
  const std::string scene = folder.write("beam.yaml", soft);
  const Result result = skyshaft({"-q", "render", "--scene", scene, "-o", folder.path("truth.exr"), "--size", "48x32",
                                  "--shafts", "reference:max_error=0.02", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("\"shafts\":\"reference:max_error=0.02\""), HasSubstr("mean_relative")));
  EXPECT_THAT(folder.names(), Contains("truth.exr"));
}

}  // namespace
}  // namespace cli
