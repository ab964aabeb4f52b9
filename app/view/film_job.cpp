#include "app/view/film_job.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <utility>

#include "engine/error.h"

extern char** environ;

namespace clatter {

FilmJob::FilmJob(const std::vector<std::string>& arguments, std::string file)
    : file_(std::move(file)) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw RunError("no pipe to a film's process");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  const int error =
      posix_spawn(&process_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  pipe_ = ends[0];
  fcntl(pipe_, F_SETFL, O_NONBLOCK);
  if (error != 0) {
    close(pipe_);
    throw RunError("a film's process does not start");
  }
}

FilmJob::~FilmJob() {
  if (process_ != 0) {
    interrupt();
    waitpid(process_, nullptr, 0);
  }
  close(pipe_);
}

void FilmJob::interrupt() const {
  if (process_ != 0) kill(process_, SIGINT);
}

void FilmJob::read() {
  std::array<char, 4096> chunk;
  for (ssize_t got; (got = ::read(pipe_, chunk.data(), chunk.size())) > 0;) {
    line_.append(chunk.data(), static_cast<std::size_t>(got));
  }
  for (std::size_t end; (end = line_.find('\n')) != std::string::npos;) {
    const std::string line = line_.substr(0, end);
    line_.erase(0, end + 1);
    const std::size_t share = line.find("\"done\":");
    if (!line.starts_with('{') || share == std::string::npos) {
      message_ = line;
    } else {
      std::sscanf(line.c_str() + share, "\"done\":%lf", &done_);
    }
  }
}

std::optional<int> FilmJob::poll() {
  int status = 0;
  const bool ended = process_ != 0 && waitpid(process_, &status, WNOHANG) == process_;
  read();
  if (!ended) return std::nullopt;
  process_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace clatter
