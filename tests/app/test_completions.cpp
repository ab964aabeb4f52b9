#include <doctest/doctest.h>

#include <sstream>
#include <utility>

#include "tests/support/shell.h"

namespace clatter {

namespace {

// The candidates of bash for the last of these words.
std::vector<std::string> candidates(const Shell& shell, const std::string& words) {
  shell.write("complete.bash",
              "source <(clatter completions bash)\n"
              "compopt() { :; }\n"
              "COMP_WORDS=(" +
                  words +
                  ")\n"
                  "COMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                  "_clatter\n"
                  "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  const Outcome outcome = shell.run("bash complete.bash");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  std::istringstream lines(outcome.out);
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) found.push_back(line);
  }
  return found;
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("Completions: bash offers commands, topics, flags, choices, scenes, files and keys") {
  const Shell shell;
  shell.write("vib.toml", "");
  const std::vector<std::pair<std::string, Words>> rows = {
      {"sc", {"scenes"}},
      {"help ren", {"render"}},
      {"help ke", {"keys"}},
      {"bench engine --are", {"--area-fraction"}},
      {"measure --backend", {}},
      {"render vibrated --progress ''", {"auto", "json", "none"}},
      {"render --seed ''", {}},
      {"view vib", {"vibrated", "vib.toml"}},
      {"measure --resume vib", {"vib.toml"}},
      {"check --set particles.inert", {"particles.inertia="}},
      {"help keys walls.top.dr", {"walls.top.drive_speed"}}};
  for (const auto& [words, found] : rows) {
    CAPTURE(words);
    CHECK(candidates(shell, "clatter " + words) == found);
  }
  shell.run("mkdir vib");
  CHECK(candidates(shell, "clatter measure --csv vib") == Words{"vib"});
}

TEST_CASE("Completions: every command has the scripts of zsh and fish") {
  const Shell shell;
  const std::string zsh = shell.run("clatter completions zsh").out;
  const std::string fish = shell.run("clatter completions fish").out;
  CHECK(zsh.starts_with("#compdef clatter\n"));
  for (const std::string command :
       {"view", "render", "measure", "check", "scenes", "convert", "bench"}) {
    CAPTURE(command);
    CHECK(says(zsh, "_clatter_" + command + "() {"));
    CHECK(says(fish, "'__clatter_command_is' -a " + command + " "));
  }
  CHECK(says(zsh, ":auto|json|none:(auto json none)'"));
  CHECK(says(fish, "measure' -l progress -d "));
  check_refused(shell, "clatter completions csh", {"'csh'"});
}

}  // namespace clatter
