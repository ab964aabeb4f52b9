#include "render/output/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstring>

#include "engine/error.h"

extern char** environ;

namespace clatter {

namespace {

// posix_spawn's two descriptions of what differs in the child.
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

ChildProcess::ChildProcess(const std::vector<std::string>& arguments)
    : errors_(memfd_create("errors", MFD_CLOEXEC)) {
  int ends[2];
  if (!errors_ || pipe2(ends, O_CLOEXEC) != 0) {
    throw RunError("cannot make a pipe to " + arguments[0] + ": " + std::strerror(errno));
  }
  const FileDescriptor output(ends[0]);
  input_ = FileDescriptor(ends[1]);

  SpawnSetup setup;
  posix_spawn_file_actions_adddup2(&setup.files, output.get(), STDIN_FILENO);
  posix_spawn_file_actions_addopen(&setup.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&setup.files, errors_.get(), STDERR_FILENO);
  sigset_t interrupts;
  sigemptyset(&interrupts);
  sigaddset(&interrupts, SIGINT);
  sigaddset(&interrupts, SIGTERM);
  posix_spawnattr_setsigmask(&setup.attributes, &interrupts);
  posix_spawnattr_setflags(&setup.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);

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

bool ChildProcess::wait() {
  input_.close();
  while (pid_ >= 0 && waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return WIFEXITED(status_) && WEXITSTATUS(status_) == 0;
}

void ChildProcess::kill() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  while (waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
}

std::string ChildProcess::last_words() const {
  constexpr off_t kLongest = 1000;
  const off_t size = lseek(errors_.get(), 0, SEEK_END);
  const off_t length = std::clamp<off_t>(size, 0, kLongest);
  std::string text(length, '\0');
  const ssize_t got = pread(errors_.get(), text.data(), length, size - length);
  text.resize(std::max<ssize_t>(got, 0));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (text.empty() && WIFSIGNALED(status_)) return strsignal(WTERMSIG(status_));
  return text;
}

}  // namespace clatter
