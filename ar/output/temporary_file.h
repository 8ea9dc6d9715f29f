#pragma once

#include <filesystem>
#include <string>

namespace ar {

// A hidden path beside a final one: what is written there appears under the final name by commit(), at once and whole,
// and is removed otherwise (except when the process is killed; then it stays, hidden, and the final name as it was).
class TemporaryPath {
 public:
  // Throws std::runtime_error where the folder does not exist or cannot be written to.
  // `overwrite`: commit() replaces what is under the final name. `in_place`: the final name itself from the start,
  // which stays whatever happens.
  explicit TemporaryPath(std::filesystem::path final_path, bool overwrite, bool in_place = false);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  // ".clip.mp4.1234-0.part" in the folder of "clip.mp4".
  const std::filesystem::path& path() const { return temporary_; }
  const std::filesystem::path& final_path() const { return final_; }
  // Renames to the final name. Throws std::runtime_error that names both; where something appeared under the final name
  // that may not be overwritten, the finished file stays under the temporary one.
  void commit();

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
  bool overwrite_ = false;
  bool committed_ = false;
};

}  // namespace ar
