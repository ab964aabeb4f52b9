#include "tests/app/shell.h"

#include <doctest/doctest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <fstream>

namespace clatter {

static std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Shell::Shell() {
  std::string pattern = std::filesystem::temp_directory_path() / "clatter-XXXXXX";
  folder_ = mkdtemp(pattern.data());
  std::filesystem::create_directory(folder_ / "here");
}

Shell::~Shell() {
  std::filesystem::remove_all(folder_);
}

Outcome Shell::run(const std::string& line, int seconds) const {
  std::ofstream(folder_ / "line") << "cd here\nPATH=" CLATTER_FOLDER ":$PATH\n" << line << '\n';
  const std::string command = "cd '" + folder_.string() + "' && timeout " +
                              std::to_string(seconds) + " sh line >out 2>err </dev/null";
  const int status = std::system(command.c_str());
  REQUIRE(WIFEXITED(status));
  return {WEXITSTATUS(status), bytes_of(folder_ / "out"), bytes_of(folder_ / "err")};
}

void Shell::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
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

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
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
