#include "engine/system/isolated.h"

#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>

#include "engine/error.h"
#include "engine/system/platform.h"

namespace clatter {

namespace {

// Exit codes of the child. They state the meaning of its bytes, and libraries do not use them.
enum Answer { kResult = 100, kWrongInput = 101, kFailedRun = 102, kNoMemory = 103 };

// A process that is killed unless it was waited for.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (pid_ < 0) return;
    kill();
    wait();
  }

  void kill() const { ::kill(pid_, SIGKILL); }

  // Its status, from waitpid().
  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
    pid_ = -1;
    return status;
  }

 private:
  pid_t pid_;
};

// Texts with their lengths.
std::string bytes_of(const UserError& error) {
  const Place& place = error.place();
  std::string bytes;
  for (const std::string& text : {place.file, std::to_string(place.line),
                                  std::to_string(place.column), error.problem(), error.advice()}) {
    bytes += std::to_string(text.size()) + ' ' + text;
  }
  return bytes;
}

UserError user_error_of(const std::string& bytes) {
  std::istringstream stream(bytes);
  std::array<std::string, 5> texts;
  for (std::string& text : texts) {
    std::size_t size = 0;
    stream >> size;
    stream.get();
    text.resize(std::min(size, bytes.size()));
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  }
  const auto& [file, line, column, problem, advice] = texts;
  return {{file, std::stoi(line), std::stoi(column)}, problem, advice};
}

// Lowers a limit of this process. Returns the earlier one.
rlimit lower_limit(int resource, std::uint64_t most) {
  rlimit before{};
  getrlimit(resource, &before);
  rlimit limit = before;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, most);
  setrlimit(resource, &limit);
  return before;
}

// The shadow memory of a sanitizer alone is beyond the limit, and nothing could be allocated. The
// limit is then lifted.
void limit_memory(std::uint64_t bytes) {
  const rlimit before = lower_limit(RLIMIT_AS, bytes);
  const std::size_t half = bytes / 2;
  void* probe = mmap(nullptr, half, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (probe == MAP_FAILED) {
    setrlimit(RLIMIT_AS, &before);
  } else {
    munmap(probe, half);
  }
}

// Ends the child without the destructors and the buffered output of the parent.
[[noreturn]] void run_as_child(const std::function<std::string()>& work, const WorkLimits& limits,
                               FileDescriptor& pipe) noexcept {
  // Handlers of a sanitizer or of Python do not see crashes that are expected.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) {
    std::signal(signal, SIG_DFL);
  }
  lower_limit(RLIMIT_CORE, 0);
  lower_limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.processor_time));
  limit_memory(limits.memory);
  std::string bytes;
  Answer answer = kResult;
  try {
    bytes = work();
  } catch (const UserError& error) {
    answer = kWrongInput;
    bytes = bytes_of(error);
  } catch (const std::bad_alloc&) {
    answer = kNoMemory;
  } catch (const std::exception& error) {
    answer = kFailedRun;
    bytes = error.what();
  }
  _exit(pipe.write_all(std::as_bytes(std::span(bytes))) ? answer : 1);
}

// Appends the bytes of a pipe until its end. False if none came during this time in all. Each wait
// counts for a second, so the time for which both processes are stopped does not count.
bool drain(const FileDescriptor& pipe, int seconds, std::string& bytes) {
  constexpr int kSecond = 1000;
  constexpr std::size_t kPart = 1 << 16;
  for (int idle = 0; idle < seconds;) {
    pollfd filled{pipe.get(), POLLIN, 0};
    const int ready = poll(&filled, 1, kSecond);
    if (ready == 0) ++idle;
    if (ready <= 0) continue;
    const std::size_t size = bytes.size();
    bytes.resize(size + kPart);
    const ssize_t got = read(pipe.get(), bytes.data() + size, kPart);
    bytes.resize(size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return true;
  }
  return false;
}

}  // namespace

WorkOutcome run_isolated(const std::function<std::string()>& work, const WorkLimits& limits) {
  std::optional<Pipe> pipe = make_pipe();
  const pid_t parent = getpid();
  const pid_t pid = pipe ? fork() : -1;
  if (pid < 0) {
    throw RunError(std::string("cannot start a process: ") + std::strerror(errno) +
                   "; end other programs, or raise the limits of the shell (ulimit -u, -n, -v)");
  }
  if (pid == 0) {
    end_with_parent();
    if (getppid() != parent) _exit(1);  // it had ended before
    pipe->output.close();
    run_as_child(work, limits, pipe->input);
  }
  Child child(pid);
  pipe->input.close();
  WorkOutcome outcome;
  const bool answered = drain(pipe->output, limits.idle_time, outcome.bytes);
  if (!answered) child.kill();
  const int status = child.wait();
  if (!answered) {
    return {"", "gave no answer within " + std::to_string(limits.idle_time) + " seconds"};
  }
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal != SIGXCPU) return {"", std::string("crashed (") + strsignal(signal) + ')'};
    return {"", "gave no answer within " + std::to_string(limits.processor_time) +
                    " seconds of CPU time"};
  }
  switch (WEXITSTATUS(status)) {
    case kResult:
      return outcome;
    case kWrongInput:
      throw user_error_of(outcome.bytes);
    case kFailedRun:
      throw RunError(outcome.bytes);
    case kNoMemory:
      return {"", "needs more than " + std::to_string(limits.memory / 1'000'000) + " MB of memory"};
    default:  // for example a finding of a sanitizer
      throw RunError("a child process has ended with exit code " +
                     std::to_string(WEXITSTATUS(status)));
  }
}

}  // namespace clatter
