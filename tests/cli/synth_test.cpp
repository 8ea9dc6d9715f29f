// `skyshaft synth` and `skyshaft contact` as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "tests/testing/run_program.h"

namespace {

using ::testing::HasSubstr;

constexpr const char* kSpec = R"(skyshaft_synth: 1
size: [320, 240]
fps: 25
frames: 3
samples: 4
place: { latitude: 48.86, longitude: 2.29 }
time: 2024-06-21T10:00:00Z
camera: { fov_deg: 60 }
path: { orbit: { center: [0, 0, 0], radius: 2, height: 1.5, from_deg: 180, to_deg: 190 } }
tags:
  family: tag36h11
  size: 0.5
  map: [ { id: 3, position: [0, 0, 0.01], flat: { top_edge_heading_deg: 0 } } ]
ground: { surface: plain, around: plain }
)";

cli::Result synth(const cli::Folder& folder, const std::string& spec, const std::string& clip) {
  return cli::skyshaft({"synth", folder.write("spec.yaml", spec), "-o", folder.path(clip)});
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// Width and height out of a PNG's header chunk, big-endian at byte 16.
std::pair<int, int> png_size(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<unsigned char> head(24);
  in.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  const auto number = [&](std::size_t at) {
    return (head[at] << 24) | (head[at + 1] << 16) | (head[at + 2] << 8) | head[at + 3];
  };
  return {number(16), number(20)};
}

TEST(Synth, WritesTheClipAndTheTruthBesideIt) {
  const cli::Folder folder;
  const cli::Result result = synth(folder, kSpec, "clip.mp4");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(folder.names(), ::testing::IsSupersetOf({"clip.mp4", "clip.truth.csv", "clip.corners.csv",
                                                       "clip.camera.yaml", "clip.scene.yaml"}));
  const auto truth = cli::read_csv(folder.path("clip.truth.csv"));
  ASSERT_EQ(truth.size(), 4U) << "a header and a row a frame";
  EXPECT_EQ(truth[0][0], "frame");
  EXPECT_EQ(truth[1].back(), "3") << "the tag is wholly in the picture";
  EXPECT_NEAR(std::stod(truth[1][5]), 1.5, 1e-6) << "the orbit's height";
  EXPECT_EQ(cli::read_csv(folder.path("clip.corners.csv")).size(), 4U);
}

TEST(Synth, KeepsAnExistingClip) {
  const cli::Folder folder;
  folder.write("clip.mp4", "mine");
  const cli::Result result = synth(folder, kSpec, "clip.mp4");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("clip.mp4: exists already"));
  EXPECT_EQ(cli::read_csv(folder.path("clip.mp4"))[0][0], "mine");
}

TEST(Synth, NamesFileLineAndKeyOfABadSpec) {
  const cli::Folder folder;
  const auto error = [&](const std::string& from, const std::string& to) {
    const cli::Result result = synth(folder, replaced(kSpec, from, to), "clip.mp4");
    EXPECT_NE(result.status, 0);
    return result.err;
  };
  EXPECT_THAT(error("samples: 4", "sampels: 4"), AllOf(HasSubstr("spec.yaml:5"), HasSubstr("sampels")));
  EXPECT_THAT(error("samples: 4", "fps: 30"), AllOf(HasSubstr("spec.yaml:5"), HasSubstr("fps")));
  EXPECT_THAT(error("fps: 25", "fps: fast"), AllOf(HasSubstr("spec.yaml:3"), HasSubstr("fps"), HasSubstr("fast")));
  EXPECT_THAT(error("frames: 3", "frames: -3"), AllOf(HasSubstr("spec.yaml:4"), HasSubstr("frames"), HasSubstr("-3")));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"spec.yaml"}) << "nothing is left behind";
}

TEST(Contact, PutsEvenlySpacedFramesBeforeAboveAfter) {
  const cli::Folder folder;
  ASSERT_EQ(synth(folder, kSpec, "clip.mp4").status, 0);
  const std::string clip = folder.path("clip.mp4");
  const std::string sheet = folder.path("sheet.png");
  const cli::Result result = cli::skyshaft({"contact", clip, clip, "-o", sheet, "--columns", "3", "--width", "160"});
  ASSERT_EQ(result.status, 0) << result.err;
  const auto [width, height] = png_size(sheet);
  // Three columns and two rows of 160x120, and the gaps between them.
  EXPECT_GE(width, 3 * 160);
  EXPECT_LT(width, 3 * 160 + 80);
  EXPECT_GE(height, 2 * 120);
  EXPECT_LT(height, 2 * 120 + 80);
}

}  // namespace
