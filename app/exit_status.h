#pragma once

namespace app {

// Exit statuses of the program (docs/architecture.md, "Errors and exit status").
enum ExitStatus : int {
  kDone = 0,
  kFailed = 1,
  kWrongUsage = 2,
  kInputUnreadable = 3,
  kCalibrationRejected = 4,
  kInterrupted = 130
};

}  // namespace app
