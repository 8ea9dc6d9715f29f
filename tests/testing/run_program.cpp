#include "tests/testing/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "render/base/csv.h"

namespace cli {
namespace {

std::string read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// In the child: standard input from nothing, output and errors into files.
[[noreturn]] void become(const std::vector<std::string>& command, const std::string& out, const std::string& err) {
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  execvp(argv[0], argv.data());
  _exit(127);
}

}  // namespace

Result run(const std::vector<std::string>& command, const std::optional<Kill>& kill) {
  const Folder folder;
  const std::string out = folder.path("out");
  const std::string err = folder.path("err");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) become(command, out, err);
  int status = 0;
  bool ended = false;
  if (kill) {
    while (!ended && !kill->when()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      ended = waitpid(child, &status, WNOHANG) == child;
    }
    if (!ended) ::kill(child, kill->signal);
  }
  if (!ended) waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_all(out), read_all(err)};
}

Result skyshaft(const std::vector<std::string>& arguments, const std::optional<Kill>& kill) {
  std::vector<std::string> command{SKYSHAFT_BINARY_DIR "/skyshaft"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run(command, kill);
}

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "skyshaft-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
  return path(name);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
  return names;
}

std::vector<std::vector<std::string>> read_csv(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream in(path);
  render::CsvRecords records(in);
  while (auto record = records.next()) rows.push_back(std::move(*record));
  return rows;
}

}  // namespace cli
