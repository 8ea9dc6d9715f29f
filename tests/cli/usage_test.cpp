// What the program says of itself and of wrong usage.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "tests/testing/run_program.h"

namespace cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The words that a help page lists below "Subcommands:".
std::vector<std::string> listed_commands(const std::string& page) {
  std::vector<std::string> commands;
  std::istringstream lines(page);
  std::string line;
  while (std::getline(lines, line) && line != "Subcommands:") {
  }
  while (std::getline(lines, line) && line.starts_with("  ")) {
    // Deeper lines go on with a description.
    if (line.at(2) != ' ') commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return commands;
}

// The page of `skyshaft WORDS --help`, and those of the commands below it. Returns how many there are.
int expect_pages(const std::vector<std::string>& words) {
  std::string command = "skyshaft";
  for (const std::string& word : words) command += " " + word;
  SCOPED_TRACE(command);
  std::vector<std::string> arguments = words;
  arguments.emplace_back("--help");
  const Result result = skyshaft(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, testing::IsEmpty());
  EXPECT_THAT(result.out, HasSubstr("Usage: " + command + " "));
  EXPECT_THAT(result.out, HasSubstr("Example"));
  int pages = 1;
  for (const std::string& below : listed_commands(result.out)) {
    arguments.back() = below;
    pages += expect_pages(arguments);
  }
  return pages;
}

TEST(Help, EveryCommandHasAPageWithAnExampleOnStandardOutput) {
  // skyshaft itself, its sixteen commands and the five of `camera`; more may come.
  EXPECT_GE(expect_pages({}), 1 + 16 + 5);
}

TEST(Help, ListsEveryCommandThereIsASourceOf) {
  const std::vector<std::string> listed = listed_commands(skyshaft({"--help"}).out);
  for (const auto& entry : std::filesystem::directory_iterator(SKYSHAFT_SOURCE_DIR "/app/cmd")) {
    const std::string name = entry.path().stem();
    if (entry.path().extension() == ".cpp") EXPECT_THAT(listed, testing::Contains(name));
  }
}

TEST(Usage, VersionIsPrinted) {
  const Result result = skyshaft({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("skyshaft 0."));
}

TEST(Usage, NoCommandPrintsHelpWithStatus2) {
  const Result result = skyshaft({});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("process"));
  EXPECT_THAT(result.out, testing::IsEmpty());
}

// Wrong words, missing options, values out of range: 2, never a library's own number.
TEST(Usage, WrongUsageIsStatus2WithAHint) {
  const std::vector<std::vector<std::string>> wrong{
      {"proces"},
      {"process"},
      {"process", "in.mp4", "-o", "out.mp4", "--scene", "s.yaml", "--nonsense"},
      {"process", "in.mp4", "-o", "out.mp4", "--scene", "s.yaml", "--crf", "99"},
      {"process", "in.mp4", "-o", "out.mp4", "--scene", "s.yaml", "--frames", "9:3"},
      {"process", "in.mp4", "-o", "out.mp4", "--scene", "s.yaml", "--shafts", "marsh"},
      {"process", "in.mp4", "-o", "out.mp4", "--scene", "s.yaml", "--fov", "60", "--camera", "c.yaml"},
      {"render", "--scene", "s.yaml"},
      {"render", "--scene", "s.yaml", "-o", "out.jpg"},
  };
  for (const auto& arguments : wrong) {
    const Result result = skyshaft(arguments);
    EXPECT_EQ(result.status, 2) << testing::PrintToString(arguments) << '\n' << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("skyshaft: ")) << testing::PrintToString(arguments);
    EXPECT_THAT(result.out, testing::IsEmpty());
  }
}

TEST(Usage, PlaceAndTimeOfTheCommandLineAreChecked) {
  const Folder folder;
  const std::string scene = folder.write("s.yaml", "skyshaft: 1\n");
  Result result = skyshaft({"explain", "--scene", scene, "--at", "95,2", "--time", "2024-06-21T07:30:00Z"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--at"));
  result = skyshaft({"explain", "--scene", scene, "--at", "45,2", "--time", "2024-06-21T07:30"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--time"));
}

TEST(Usage, ExplainNeedsPlaceAndTimeOrASun) {
  const Folder folder;
  const Result result = skyshaft({"explain", "--scene", folder.write("s.yaml", "skyshaft: 1\n")});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("place and time"));
}

TEST(Explain, SaysWhichPassesAndWhyNotTheOthers) {
  const Folder folder;
  const std::string scene = folder.write("s.yaml",
                                         "skyshaft: 1\n"
                                         "sun: { azimuth_deg: 135, elevation_deg: 32, illuminance_lux: 90000 }\n"
                                         "medium: { visibility: 30 }\n");
  const Result result = skyshaft({"explain", "--scene", scene});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("shafts"));
  EXPECT_THAT(result.out, HasSubstr("closed-form"));
  EXPECT_THAT(result.out, HasSubstr("left out\n"));
  EXPECT_THAT(result.out, HasSubstr("shadow       because nothing in the scene casts"));
}

TEST(Explain, TheProjectsScenesAllNeedPlansOfTheirOwn) {
  std::map<std::string, std::string> scene_of_plan;
  for (const auto& entry : std::filesystem::directory_iterator(SKYSHAFT_SOURCE_DIR "/data/scenes")) {
    const Result result = skyshaft({"explain", "--scene", entry.path().string()});
    ASSERT_EQ(result.status, 0) << result.err;
    const std::string plan = result.out.substr(result.out.find("passes\n"));
    const auto [other, is_new] = scene_of_plan.emplace(plan, entry.path().filename());
    EXPECT_TRUE(is_new) << entry.path() << " is planned as " << other->second << " is:\n" << plan;
  }
  EXPECT_GE(scene_of_plan.size(), 10U);
}

TEST(Doctor, NamesTheRendererAndTheEncoders) {
  const Result result = skyshaft({"doctor"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("OpenGL ES 3."));
  EXPECT_THAT(result.out, HasSubstr("h264"));
  EXPECT_THAT(result.out, Not(HasSubstr("MISSING")));
}

}  // namespace
}  // namespace cli
