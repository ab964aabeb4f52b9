#include "tests/support/shell.h"

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>

namespace clatter {

using namespace testing;

Shell::Shell() {
  std::filesystem::create_directory(folder_ / "here");
}

// A program with sanitizers is several times slower, and so is its time limit.
constexpr bool kSanitized = sizeof(CLATTER_SANITIZE) > 1;
constexpr int kSlowness = kSanitized ? 5 : 1;

Outcome Shell::run(const std::string& line, int seconds) const {
  folder_.write("line", "cd here\nPATH=" CLATTER_FOLDER ":$PATH\n" + line + '\n');
  const std::string command = "cd '" + (folder_ / "").string() + "' && timeout " +
                              std::to_string(kSlowness * seconds) +
                              " sh line >out 2>err </dev/null";
  const int status = std::system(command.c_str());
  REQUIRE(WIFEXITED(status));
  return {WEXITSTATUS(status), bytes_of(folder_ / "out"), bytes_of(folder_ / "err")};
}

void Shell::write(const std::string& name, const std::string& text) const {
  write_bytes(path(name), text);
}

std::string Shell::read(const std::string& name) const {
  return bytes_of(path(name));
}

std::vector<std::string> Shell::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "here")) {
    names.push_back(entry.path().filename());
  }
  std::ranges::sort(names);
  return names;
}

bool is_sanitized() {
  return kSanitized;
}

Outcome cut_off(const Shell& shell, const std::string& line, const std::string& signal) {
  return shell.run(line +
                   " --checkpoint c --checkpoint-every 0.02 & pid=$!\n"
                   "while [ ! -e c ] && kill -0 $pid; do sleep 0.02; done\n"
                   "kill -" +
                   signal + " $pid; wait $pid");
}

void check_refused(const Shell& shell, const std::string& line,
                   const std::vector<std::string>& parts) {
  CAPTURE(line);
  const std::vector<std::string> before = shell.files();
  const Outcome outcome = shell.run(line);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  for (const std::string& part : parts) {
    CAPTURE(part);
    CHECK(says(outcome.err, part));
  }
  CHECK(shell.files() == before);
}

}  // namespace clatter
