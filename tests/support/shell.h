#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

using testing::says;

/// The result of a command line: its exit code and its output.
struct Outcome {
  int code = 0;
  std::string out;
  std::string err;
};

/// A temporary folder in which command lines run as in a terminal. `clatter` is the program of this
/// build.
class Shell {
 public:
  Shell();

  /// Runs a line of POSIX shell, for at most `seconds` (then exit code 124).
  Outcome run(const std::string& line, int seconds = 60) const;

  /// Writes a file into the folder.
  void write(const std::string& name, const std::string& text) const;
  /// The bytes of a file in the folder.
  std::string read(const std::string& name) const;
  /// The path of a file in the folder.
  std::filesystem::path path(const std::string& name) const { return folder_ / ("here/" + name); }
  /// The names in the folder, sorted.
  std::vector<std::string> files() const;

 private:
  testing::TemporaryFolder folder_;
};

/// Whether the program has a sanitizer. This takes memory and time, and prevents LD_PRELOAD and
/// limits of the address space.
bool is_sanitized();

/// Starts a line with `--checkpoint c` in the background. A signal ends it as soon as a checkpoint
/// exists, on any machine.
Outcome cut_off(const Shell& shell, const std::string& line, const std::string& signal);

/// Runs a line that must fail as wrong use: exit code 2, a message with all of `parts`, an empty
/// stdout and no file.
void check_refused(const Shell& shell, const std::string& line,
                   const std::vector<std::string>& parts);

}  // namespace clatter
