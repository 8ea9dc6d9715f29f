#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct Result {
  int status = -1;  // exit status, or 128 + signal
  std::string out;
  std::string err;
};

// A signal that is sent to the program as soon as something is so.
struct Kill {
  int signal = 0;
  std::function<bool()> when;
};

// Runs build/.../skyshaft with these arguments, without a shell, and waits for it.
Result skyshaft(const std::vector<std::string>& arguments, const std::optional<Kill>& kill = std::nullopt);
// Any program that is on the path.
Result run(const std::vector<std::string>& command, const std::optional<Kill>& kill = std::nullopt);

// A folder of this test's own that goes when the object goes.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  // Writes a text file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  // Names of everything inside, hidden files included.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

// Rows of a CSV file without quoted fields, the header first.
std::vector<std::vector<std::string>> read_csv(const std::string& path);

}  // namespace cli
