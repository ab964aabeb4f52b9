#pragma once

namespace clatter {

/// The exit codes of the program.
enum ExitCode {
  kOk = 0,
  kFailed = 1,        ///< a run or a check failed
  kWrongUse = 2,      ///< wrong use or a wrong scene
  kPhysicalStop = 3,  ///< collapse, overlap
  kInterrupted = 130  ///< by a signal; the results so far are saved
};

}  // namespace clatter
