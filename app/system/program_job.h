#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/system/child_process.h"

namespace clatter {

/// A command of this program in a child process, with --progress json.
class ProgramJob {
 public:
  /// Starts this program. `arguments[0]` is its name. Throws RunError if the process cannot start.
  explicit ProgramJob(std::vector<std::string> arguments);
  ProgramJob(const ProgramJob&) = delete;
  ProgramJob& operator=(const ProgramJob&) = delete;
  /// Interrupts an unfinished command and waits for its end.
  ~ProgramJob();

  /// Reads the output of the process. Returns its exit code after it has ended.
  std::optional<int> poll();
  /// Interrupts the command. It keeps its results so far.
  void interrupt() const { process_.interrupt(); }
  /// Completed share of the work, 0..1.
  double done() const { return done_; }
  /// Last output line that is not a progress report: the error message, if any.
  const std::string& message() const { return message_; }
  /// The process.
  const ChildProcess& process() const { return process_; }

 private:
  void read();

  ChildProcess process_;
  std::string line_;  // incomplete line of output
  std::string message_;
  double done_ = 0.0;
};

}  // namespace clatter
