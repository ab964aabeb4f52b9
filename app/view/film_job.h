#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/system/child_process.h"

namespace clatter {

/// Runs `clatter render` in a child process, in parallel with the window.
class FilmJob {
 public:
  /// Starts this program with `arguments`, which write a film to `file`. Throws RunError if the
  /// process cannot start.
  FilmJob(std::vector<std::string> arguments, std::string file);
  FilmJob(const FilmJob&) = delete;
  FilmJob& operator=(const FilmJob&) = delete;
  /// Interrupts an unfinished film. The partial film is playable.
  ~FilmJob();

  /// Reads the output of the process. Returns its exit code after it has ended.
  std::optional<int> poll();
  /// Interrupts the process. The partial film is playable.
  void interrupt() const { process_.interrupt(); }
  /// Completed fraction of the film, 0..1.
  double done() const { return done_; }
  /// Path of the film.
  const std::string& file() const { return file_; }
  /// Last output line that is not a progress report: the error message, if any.
  const std::string& message() const { return message_; }

 private:
  void read();

  std::string file_;
  ChildProcess process_;
  std::string line_;  // incomplete last line
  double done_ = 0.0;
  std::string message_;
};

}  // namespace clatter
