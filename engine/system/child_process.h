#pragma once

#include <sys/types.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/system/file_descriptor.h"

namespace clatter {

/// Whether an interrupt of our program, at the terminal or by a batch system, reaches its children.
enum class Interrupts {
  Shielded,  ///< a child has a process group of its own and blocks SIGINT, SIGTERM and SIGHUP
  Shared     ///< a child gets what we get
};

/// A program that runs beside ours and may read what we write.
class ChildProcess {
 public:
  /// Starts `arguments[0]`, found on the PATH, without any shell; where it is shielded from
  /// interrupts, it has time to end well. Throws RunError.
  explicit ChildProcess(const std::vector<std::string>& arguments,
                        Interrupts interrupts = Interrupts::Shielded);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills it where it has not been seen to end.
  ~ChildProcess();

  /// Writes to its standard input; false once it no longer reads. SIGPIPE must be blocked.
  bool write(std::span<const unsigned char> bytes) {
    return input_.write_all(std::as_bytes(bytes));
  }
  /// Ends its input and waits for its end; true where it succeeded.
  bool wait();
  /// Its exit code once it has ended, 128 where a signal ended it; absent: it still runs.
  std::optional<int> poll();
  /// Sends it SIGINT where it still runs.
  void interrupt() const;
  /// Ends it at once: a write() under way on another thread then fails.
  void kill();
  /// What it has written on its standard error since the last call.
  std::string new_words();
  /// The end of what it wrote on its standard error, or which signal ended it.
  std::string last_words() const;

 private:
  bool take_end(int options);

  pid_t pid_ = -1;         ///< -1: has ended
  int status_ = 0;         ///< of its end, as waitpid() tells it
  FileDescriptor input_;   ///< our end of the pipe
  FileDescriptor errors_;  ///< a file, which never makes it wait
  off_t read_ = 0;         ///< bytes of that which new_words() has given
};

}  // namespace clatter
