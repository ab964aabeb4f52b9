#pragma once

#include <sys/types.h>

#include <span>
#include <string>
#include <vector>

#include "render/output/file_descriptor.h"

namespace clatter {

/// A program that runs beside ours and reads what we write.
class ChildProcess {
 public:
  /// Starts `arguments[0]`, found on the PATH, without any shell. It has a process group of its own
  /// and blocks SIGINT and SIGTERM, so that an interrupt, at the terminal or by a batch system,
  /// leaves it time to end well. Throws RunError.
  explicit ChildProcess(const std::vector<std::string>& arguments);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills it where wait() was not called.
  ~ChildProcess();

  /// Writes to its standard input; false once it no longer reads. SIGPIPE must be blocked.
  bool write(std::span<const unsigned char> bytes) { return input_.write_all(bytes); }
  /// Ends its input and waits for its end; true where it succeeded.
  bool wait();
  /// Ends it at once: a write() under way on another thread then fails.
  void kill();
  /// The end of what it wrote on its standard error, or which signal ended it.
  std::string last_words() const;

 private:
  pid_t pid_ = -1;         ///< -1: has ended
  int status_ = 0;         ///< of its end, as waitpid() tells it
  FileDescriptor input_;   ///< our end of the pipe
  FileDescriptor errors_;  ///< a file in memory, which never makes it wait
};

}  // namespace clatter
