#pragma once

#include <sys/types.h>

#include <string>

#include "tests/lab/uvc_descriptors.h"

namespace ar::testing {

// `skyshaft`, run beside the test, what it says going into a file.
class RunningProgram {
 public:
  // Arguments as a shell takes them; `through` is a command that runs it ("nice ").
  RunningProgram(const std::string& arguments, std::string log, const std::string& through = "");
  ~RunningProgram();  // kills it where it still runs
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  // Waits until it does nothing for two seconds: all is set up and it waits for its first frame. At most 150 s.
  bool waits() const;
  // Waits until it has said that, at most 30 s.
  bool says(const std::string& words) const;
  // All that it said so far.
  std::string log() const;

  void send(int signal) const;
  // Waits for its end. Exit status, or 128 and the signal that ended it.
  int status();

 private:
  // Processor time that it has used, in the kernel's ticks.
  long used_ticks() const;

  std::string log_;
  pid_t process_;
};

// The clip of tests/lab/make_clip.sh: its path without the ending, and its pictures as a webcam gives them.
std::string lab_clip();
WebcamStream clip_pictures();

}  // namespace ar::testing
