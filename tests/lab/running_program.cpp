#include "tests/lab/running_program.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include "ar/capture/file/open_source.h"
#include "tests/lab/lab.h"

namespace ar::testing {
namespace {

// In two seconds of doing nothing but looking for a frame now and then, on the lab's slow processors.
constexpr long kIdleTicks = 20;

}  // namespace

RunningProgram::RunningProgram(const std::string& arguments, std::string log, const std::string& through)
    : log_(std::move(log)), process_(fork()) {
  if (process_ != 0) return;
  const std::string line = fmt::format("exec {}{}/skyshaft {} >{} 2>&1", through, SKYSHAFT_BINARY_DIR, arguments, log_);
  execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
  _exit(127);
}

RunningProgram::~RunningProgram() {
  if (process_ <= 0) return;
  send(SIGKILL);
  status();
}

long RunningProgram::used_ticks() const {
  std::ifstream stat(fmt::format("/proc/{}/stat", process_));
  std::string word;
  for (int i = 0; i < 13; ++i) stat >> word;
  long user = 0;
  long system = 0;
  stat >> user >> system;
  return user + system;
}

bool RunningProgram::waits() const {
  long used = -1;
  return eventually(
      [&] {
        std::this_thread::sleep_for(2s);
        return std::exchange(used, used_ticks()) + kIdleTicks > used;
      },
      150s);
}

bool RunningProgram::says(const std::string& words) const {
  return eventually([&] { return log().find(words) != std::string::npos; }, 30s);
}

std::string RunningProgram::log() const {
  std::ifstream in(log_);
  return {std::istreambuf_iterator<char>(in), {}};
}

void RunningProgram::send(int signal) const {
  kill(process_, signal);
}

int RunningProgram::status() {
  int status = -1;
  waitpid(std::exchange(process_, -1), &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string lab_clip() {
  return SKYSHAFT_BINARY_DIR "/lab/clip";
}

WebcamStream clip_pictures() {
  WebcamStream stream;
  const auto source = open_source(lab_clip() + ".mp4");
  while (const auto frame = source->next()) {
    stream.width = frame->format.width;
    stream.height = frame->format.height;
    Bytes picture;
    for (int y = 0; y < stream.height; ++y) {
      for (int x = 0; x < stream.width; ++x) {
        const std::size_t chroma = x % 2 == 0 ? 1 : 2;
        picture.push_back(frame->plane[0][y * frame->stride_bytes[0] + x]);
        picture.push_back(frame->plane[chroma][y / 2 * frame->stride_bytes[chroma] + x / 2]);
      }
    }
    stream.pictures.push_back(std::move(picture));
  }
  return stream;
}

}  // namespace ar::testing
