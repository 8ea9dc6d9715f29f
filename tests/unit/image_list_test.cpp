// Which files a pattern or a folder means, and in which order.

#include "ar/capture/file/image_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "ar/error.h"
#include "tests/testing/made_clip.h"

namespace ar {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> listed(const testing::TemporaryFolder& folder, const std::string& pattern) {
  std::vector<std::string> names;
  for (const auto& file : list_images((folder.path() / pattern).string())) names.push_back(file.filename().string());
  return names;
}

void touch(const testing::TemporaryFolder& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) std::ofstream(folder / name) << "x";
}

TEST(ImagePattern, PrintfNumbersAreFoundAndFilledIn) {
  EXPECT_TRUE(is_printf_pattern("shot_%04d.png"));
  EXPECT_TRUE(is_printf_pattern("a/%d.png"));
  EXPECT_FALSE(is_printf_pattern("shot.png"));
  EXPECT_FALSE(is_printf_pattern("100%.png"));
  EXPECT_FALSE(is_printf_pattern("%d_%d.png"));
  EXPECT_FALSE(is_printf_pattern("%s.png"));
  EXPECT_EQ(printf_name("shot_%04d.png", 7), "shot_0007.png");
  EXPECT_EQ(printf_name("shots/%d%%.png", 12345), "shots/12345%.png");
  EXPECT_EQ(printf_name("%02d.png", 123), "123.png");
  EXPECT_THROW(printf_name("shot.png", 1), std::invalid_argument);
}

TEST(ImagePattern, PrintfTakesNumbersInOrderGapsAndAllButNothingElse) {
  const testing::TemporaryFolder folder;
  touch(folder, {"a_10.png", "a_9.png", "a_2.png", "a_02.png", "a_x.png", "b_3.png", "a_4.jpg", "a_.png"});
  EXPECT_THAT(listed(folder, "a_%d.png"), ElementsAre("a_2.png", "a_9.png", "a_10.png"));
  EXPECT_THAT(listed(folder, "a_%02d.png"), ElementsAre("a_02.png", "a_10.png"));
}

TEST(ImagePattern, GlobAndFolderAreInNaturalOrder) {
  const testing::TemporaryFolder folder;
  touch(folder, {"p10.jpg", "p9.JPG", "p9a.jpg", "p009b.jpg", "notes.txt", ".p1.jpg"});
  EXPECT_THAT(listed(folder, ""), ElementsAre("p9.JPG", "p9a.jpg", "p009b.jpg", "p10.jpg"));
  EXPECT_THAT(listed(folder, "p*.jpg"), ElementsAre("p9a.jpg", "p009b.jpg", "p10.jpg"));
}

TEST(ImagePattern, NothingFoundIsAnInputErrorWithAHint) {
  const testing::TemporaryFolder folder;
  for (const char* pattern : {"", "%d.png", "*.png"}) {
    try {
      listed(folder, pattern);
      FAIL() << "'" << pattern << "' found pictures in an empty folder";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("\n"));
    }
  }
}

}  // namespace
}  // namespace ar
