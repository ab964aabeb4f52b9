#pragma once

#include <sys/types.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/system/file_descriptor.h"

namespace clatter {

/// Whether an interrupt of this program, at the terminal or by a batch system, reaches its
/// children.
enum class Interrupts {
  Shielded,  ///< a child has its own process group and blocks SIGINT, SIGTERM and SIGHUP
  Shared     ///< a child receives the same signals
};

/// A program in a child process, with a pipe to its standard input.
class ChildProcess {
 public:
  /// Starts `arguments[0]`, found on the PATH, without a shell. A shielded process can finish its
  /// work after an interrupt of this program. Throws RunError.
  explicit ChildProcess(const std::vector<std::string>& arguments,
                        Interrupts interrupts = Interrupts::Shielded);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills the process unless wait() or poll() has seen its end.
  ~ChildProcess();

  /// Writes to its standard input; false after it has closed the input. SIGPIPE must be blocked.
  bool write(std::span<const unsigned char> bytes) {
    return input_.write_all(std::as_bytes(bytes));
  }
  /// Closes its input and waits for its end; true if it succeeded.
  bool wait();
  /// Its exit code after its end, 128 after a signal; absent while it runs.
  std::optional<int> poll();
  /// Sends it SIGINT if it still runs.
  void interrupt() const;
  /// Ends it at once. A current write() on another thread then fails.
  void kill();
  /// Its output on standard error since the last call.
  std::string new_words();
  /// The end of its output on standard error; without output, the name of the signal that ended it.
  std::string last_words() const;

 private:
  bool take_end(int options);

  pid_t pid_ = -1;         ///< -1: has ended
  int status_ = 0;         ///< status of its end, from waitpid()
  FileDescriptor input_;   ///< our end of the pipe
  FileDescriptor errors_;  ///< its standard error: a file, so that it never blocks
  off_t read_ = 0;         ///< bytes of it that new_words() has returned
};

}  // namespace clatter
