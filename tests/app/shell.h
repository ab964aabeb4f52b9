#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace clatter {

using testing::says;

/// What a command line left: its exit code and what it wrote.
struct Outcome {
  int code = 0;
  std::string out;
  std::string err;
};

/// A folder of its own, gone afterwards, in which command lines run as a person types them; the
/// program just built is `clatter` there.
class Shell {
 public:
  Shell();

  /// Runs a line of POSIX shell, for so many seconds at most (exit code 124).
  Outcome run(const std::string& line, int seconds = 60) const;

  /// Writes a file into the folder.
  void write(const std::string& name, const std::string& text) const;
  /// The bytes of a file in the folder.
  std::string read(const std::string& name) const;
  /// Where a file of the folder is.
  std::filesystem::path path(const std::string& name) const { return folder_ / ("here/" + name); }
  /// The names in the folder, sorted.
  std::vector<std::string> files() const;

 private:
  testing::TemporaryFolder folder_;
};

/// Runs a line that must be refused: exit code 2, a message that holds all of `parts`, nothing on
/// stdout and no file.
void check_refused(const Shell& shell, const std::string& line,
                   const std::vector<std::string>& parts);

}  // namespace clatter
