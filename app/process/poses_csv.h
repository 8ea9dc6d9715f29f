#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "ar/track/tracker.h"

namespace app {

// The camera's path as CSV, a row a frame:
//   frame,time_s,state,x_m,y_m,z_m,qw,qx,qy,qz,rms_px,tag_ids
// Position and orientation are world_from_camera; ids are joined by ';'; pose fields are empty while lost.
// Written beside the final name and renamed by finish(); without it nothing appears.
class PosesCsv {
 public:
  // Throws std::runtime_error when the file exists and may not be overwritten, or cannot be made.
  PosesCsv(std::filesystem::path path, bool overwrite);
  ~PosesCsv();
  PosesCsv(const PosesCsv&) = delete;
  PosesCsv& operator=(const PosesCsv&) = delete;

  void add(std::int64_t frame, double time_s, const ar::Track& track);
  void finish();

 private:
  void check() const;

  const std::filesystem::path path_;
  const std::filesystem::path beside_;
  const bool overwrite_;
  std::ofstream out_;
  bool finished_ = false;
};

}  // namespace app
