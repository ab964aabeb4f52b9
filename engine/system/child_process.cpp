#include "engine/system/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>

#include "engine/error.h"
#include "engine/system/platform.h"

extern char** environ;

namespace clatter {

namespace {

// Settings of the child for posix_spawn.
struct SpawnSetup {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  SpawnSetup() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, Interrupts interrupts,
                           StopRequest stop)
    : errors_(nameless_file()), stop_(std::move(stop)) {
  std::optional<Pipe> pipe;
  if (errors_) pipe = make_pipe();
  if (!pipe) {
    throw RunError("cannot make a pipe to " + arguments[0] + ": " + std::strerror(errno));
  }
  input_ = std::move(pipe->input);
  fcntl(input_.get(), F_SETFL, O_NONBLOCK);

  SpawnSetup setup;
  posix_spawn_file_actions_adddup2(&setup.files, pipe->output.get(), STDIN_FILENO);
  posix_spawn_file_actions_addopen(&setup.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&setup.files, errors_.get(), STDERR_FILENO);
  if (interrupts == Interrupts::Shielded) {
    sigset_t blocked;
    sigemptyset(&blocked);
    for (const int signal : kInterrupts) sigaddset(&blocked, signal);
    posix_spawnattr_setsigmask(&setup.attributes, &blocked);
    posix_spawnattr_setflags(&setup.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  }

  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int error =
      posix_spawnp(&pid_, argv[0], &setup.files, &setup.attributes, argv.data(), environ);
  if (error) throw RunError("cannot start " + arguments[0] + ": " + std::strerror(error));
}

ChildProcess::~ChildProcess() {
  kill();
}

// Records the end of the process, as waitpid() with these options; false if it still runs.
bool ChildProcess::take_end(int options) {
  pid_t ended = -1;
  do {
    ended = waitpid(pid_, &status_, options);
  } while (ended < 0 && errno == EINTR);
  if (ended == 0) return false;
  pid_ = -1;
  return true;
}

// Whether it must be given up: it has read nothing since `last_read`. The time counts from the stop
// request.
bool ChildProcess::hangs(Clock::time_point& last_read) {
  constexpr std::chrono::seconds kPatience{3};  // an encoder starts slowly on a busy machine
  const Clock::time_point now = Clock::now();
  if (!stop_.made()) last_read = now;
  hung_ = now - last_read > kPatience;
  return hung_;
}

// Number of bytes in the pipe to its input.
int ChildProcess::unread() const {
  int bytes = 0;
  return ioctl(input_.get(), FIONREAD, &bytes) == 0 ? bytes : 0;
}

bool ChildProcess::write(std::span<const unsigned char> bytes) {
  constexpr int kMilliseconds = 100;
  Clock::time_point last_read = Clock::now();
  while (!bytes.empty()) {
    const ssize_t written = ::write(input_.get(), bytes.data(), bytes.size());
    if (written > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      last_read = Clock::now();
      continue;
    }
    if (errno != EAGAIN && errno != EINTR) return false;
    if (hangs(last_read)) return false;
    pollfd room{input_.get(), POLLOUT, 0};
    ::poll(&room, 1, kMilliseconds);
  }
  return true;
}

bool ChildProcess::wait() {
  constexpr int kMilliseconds = 2;
  Clock::time_point last_read = Clock::now();
  for (int before = 0, now; pid_ >= 0 && (now = unread()) > 0 && !take_end(WNOHANG); before = now) {
    if (now != before) last_read = Clock::now();
    if (hangs(last_read)) {
      kill();
      break;
    }
    pollfd closed{input_.get(), 0, 0};
    if (::poll(&closed, 1, kMilliseconds) > 0) break;
  }
  input_.close();
  if (pid_ >= 0) take_end(0);
  return WIFEXITED(status_) && WEXITSTATUS(status_) == 0;
}

std::optional<int> ChildProcess::poll() {
  if (pid_ >= 0 && !take_end(WNOHANG)) return std::nullopt;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128;
}

void ChildProcess::interrupt() const {
  if (pid_ >= 0) ::kill(pid_, SIGTERM);
}

void ChildProcess::kill() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  take_end(0);
}

// The pipe to a process reports an error when no process can read from it any more.
void wait_for_any(std::span<const ChildProcess* const> processes, std::chrono::milliseconds most) {
  std::vector<pollfd> pipes;
  for (const ChildProcess* process : processes) pipes.push_back({process->input_.get(), 0, 0});
  ::poll(pipes.data(), pipes.size(), static_cast<int>(most.count()));
}

// At most `size` bytes of a file from `begin`.
static std::string text_at(const FileDescriptor& file, std::uint64_t begin, std::uint64_t size) {
  std::string text(size, '\0');
  text.resize(file.read_at(begin, text));
  return text;
}

std::string ChildProcess::new_words() {
  const std::string text = text_at(errors_, read_, errors_.size().value_or(read_) - read_);
  read_ += text.size();
  return text;
}

std::string ChildProcess::last_words() const {
  constexpr std::uint64_t kLongest = 1000;
  const std::uint64_t size = errors_.size().value_or(0);
  const std::uint64_t length = std::min(size, kLongest);
  std::string text = text_at(errors_, size - length, length);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (text.empty() && hung_) return "it does not read its input";
  return text.empty() ? signal() : text;
}

std::string ChildProcess::signal() const {
  return WIFSIGNALED(status_) ? strsignal(WTERMSIG(status_)) : "";
}

void continue_as(const char* program, const char* argument) {
  execlp(program, program, argument, nullptr);
}

}  // namespace clatter
