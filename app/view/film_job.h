#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/system/child_process.h"

namespace clatter {

/// `clatter render` in a process of its own, which films while the window goes on.
class FilmJob {
 public:
  /// Starts this program with the arguments of a film into `file`. Throws RunError where it cannot.
  FilmJob(std::vector<std::string> arguments, std::string file);
  FilmJob(const FilmJob&) = delete;
  FilmJob& operator=(const FilmJob&) = delete;
  /// Interrupts the film if it is not done, so that what there is of it plays.
  ~FilmJob();

  /// Takes what the process has told; its exit code once it has ended.
  std::optional<int> poll();
  /// Asks it to end; what there is of the film plays.
  void interrupt() const { process_.interrupt(); }
  /// The share of the film that is done, 0..1.
  double done() const { return done_; }
  /// The film.
  const std::string& file() const { return file_; }
  /// The last line that it told and that was no progress: what went wrong.
  const std::string& message() const { return message_; }

 private:
  void read();

  std::string file_;
  ChildProcess process_;
  std::string line_;  // not yet whole
  double done_ = 0.0;
  std::string message_;
};

}  // namespace clatter
