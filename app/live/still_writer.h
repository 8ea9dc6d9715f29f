#pragma once

#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "app/live/live_frame.h"
#include "ar/capture/source.h"

namespace app {

// Writes stills as PNG beside the live pictures: each on a thread of its own, so that nothing waits.
class StillWriter {
 public:
  StillWriter(std::filesystem::path folder, ar::SourceInfo source);

  // Returns the file's name, after the time of day.
  std::string write(const ShownPicture& shown);
  // Waits for all of them and warns of those that failed.
  void finish();

 private:
  const std::filesystem::path folder_;
  const ar::SourceInfo source_;
  std::vector<std::future<void>> writing_;
};

}  // namespace app
