#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/boards/observation.h"

namespace app {

// What one input (a picture, a recording, a folder) showed of a board.
struct LookedAt {
  std::string input;
  int width = 0;
  int height = 0;
  bool video = false;
  std::vector<calib::Observation> frames;  // those without the board too, with no points
};

// Corners that were found before, in a JSON file. An input's are taken again as long as its path, size and time of
// change are the same, and the board is.
class CornersCache {
 public:
  // An empty path keeps nothing. Throws ar::InputError when the file is there but is no cache of corners; one of
  // another board is started anew.
  CornersCache(const std::filesystem::path& file, const std::string& board_text);

  std::optional<LookedAt> find(const std::string& input) const;
  void keep(const LookedAt& looked);
  // Writes the file if anything new was kept.
  void save() const;

 private:
  std::filesystem::path file_;
  std::string board_text_;
  std::map<std::string, std::string> entries_;  // JSON by input
  bool changed_ = false;
};

}  // namespace app
