#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <csignal>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/stop_request.h"
#include "engine/system/file_descriptor.h"

namespace clatter {

/// The signals that request the end of a run, at the terminal or by a batch system.
inline constexpr std::array kInterrupts = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2};

/// Whether an interrupt of this program, at the terminal or by a batch system, reaches its
/// children.
enum class Interrupts {
  Shielded,  ///< a child has its own process group and blocks kInterrupts
  Shared     ///< a child receives the same signals
};

class ChildProcess;

/// Waits until one of these processes ends, for at most this time. A signal ends the wait too.
void wait_for_any(std::span<const ChildProcess* const> processes, std::chrono::milliseconds most);

/// A program in a child process, with a pipe to its standard input.
class ChildProcess {
 public:
  /// Starts `arguments[0]`, found on the PATH, without a shell. A shielded process can finish its
  /// work after an interrupt of this program. After the stop request, write() and
  /// wait() end a process that does not read its input for one second. Throws RunError.
  explicit ChildProcess(const std::vector<std::string>& arguments,
                        Interrupts interrupts = Interrupts::Shielded, StopRequest stop = {});
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills the process unless wait() or poll() has seen its end.
  ~ChildProcess();

  /// Writes to its standard input; false after it has closed the input, or if it hangs. SIGPIPE
  /// must be blocked.
  bool write(std::span<const unsigned char> bytes);
  /// Closes its input and waits for its end; true if it succeeded. Kills it if it hangs.
  bool wait();
  /// Its exit code after its end, 128 after a signal; absent while it runs.
  std::optional<int> poll();
  /// Sends it SIGTERM if it still runs. A job in the background of a script ignores SIGINT, and so
  /// do its children.
  void interrupt() const;
  /// Ends it at once. A current write() on another thread then fails.
  void kill();
  /// Its output on standard error since the last call.
  std::string new_words();
  /// The end of its output on standard error. Without output, the reason of its end: it hung, or
  /// the name of a signal.
  std::string last_words() const;
  /// The name of the signal that has ended it; empty: none.
  std::string signal() const;

 private:
  friend void wait_for_any(std::span<const ChildProcess* const>, std::chrono::milliseconds);
  using Clock = std::chrono::steady_clock;

  bool take_end(int options);
  bool hangs(Clock::time_point& last_read);
  int unread() const;

  pid_t pid_ = -1;          ///< -1: has ended
  int status_ = 0;          ///< status of its end, from waitpid()
  FileDescriptor input_;    ///< our end of the pipe
  FileDescriptor errors_;   ///< its standard error: a file, so that it never blocks
  std::uint64_t read_ = 0;  ///< bytes of it that new_words() has returned
  StopRequest stop_;
  bool hung_ = false;  ///< whether it was given up
};

/// Replaces this program by another one from the PATH with one argument. Returns with errno on
/// failure.
void continue_as(const char* program, const char* argument);

}  // namespace clatter
