#pragma once

namespace app {

// Exit statuses of the program (DESIGN.md section 8).
enum ExitStatus : int {
  kDone = 0,
  kFailed = 1,
  kWrongUsage = 2,
  kInputUnreadable = 3,
  kCalibrationRejected = 4,
  kInterrupted = 130
};

}  // namespace app
