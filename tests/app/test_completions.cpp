#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

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

TEST_CASE("Completions: bash offers commands, tables and the topics of help") {
  const Shell shell;
  CHECK(candidates(shell, "clatter sc") == Words{"scenes"});
  CHECK(candidates(shell, "clatter bench acc") == Words{"accuracy"});
  CHECK(candidates(shell, "clatter help ren") == Words{"render"});
  CHECK(candidates(shell, "clatter help ke") == Words{"keys"});
  CHECK(candidates(shell, "clatter completions ''") == Words{"bash", "zsh", "fish"});
}

TEST_CASE("Completions: bash offers the flags of the command and the choices of a flag") {
  const Shell shell;
  CHECK(candidates(shell, "clatter render --ba") == Words{"--backend"});
  CHECK(candidates(shell, "clatter measure --backend") == Words{});
  CHECK(candidates(shell, "clatter bench engine --are") == Words{"--area-fraction"});
  CHECK(candidates(shell, "clatter render vibrated --progress ''") ==
        Words{"auto", "json", "none"});
  CHECK(candidates(shell, "clatter render -q ''") == Words{"l", "m", "h"});
  CHECK(candidates(shell, "clatter render --seed ''") == Words{});
}

TEST_CASE("Completions: bash offers gallery names and files where a scene is expected") {
  const Shell shell;
  shell.write("vib.toml", "");
  CHECK(candidates(shell, "clatter view vib") == Words{"vibrated", "vib.toml"});
  CHECK(candidates(shell, "clatter measure --resume vib") == Words{"vib.toml"});
  CHECK(candidates(shell, "clatter render vibrated --out vib") == Words{"vib.toml"});
  shell.run("mkdir vib");
  CHECK(candidates(shell, "clatter measure --csv vib") == Words{"vib"});
}

TEST_CASE("Completions: bash offers the keys of a scene") {
  const Shell shell;
  CHECK(candidates(shell, "clatter check --set particles.inert") == Words{"particles.inertia="});
  CHECK(candidates(shell, "clatter help keys walls.top.dr") == Words{"walls.top.drive_speed"});
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
  check_refused(shell, "clatter completions csh",
                {"'csh' is unknown; give one of bash, zsh, fish"});
}

TEST_CASE("Completions: zsh and fish offer the values of each kind of flag") {
  const Shell shell;
  const std::string zsh = shell.run("clatter completions zsh").out;
  for (const char* line :
       {"'--seed[Seed of all random numbers]:N: '", "'--quiet[Print errors only on stderr]'",
        "'--progress[Form of the progress on stderr]:auto|json|none:(auto json none)'",
        "'--checkpoint[Keep a checkpoint up to date]:FILE:_files'",
        "'--csv[Folder for tables of series, profiles and maps]:DIR:_files -/'",
        "'*--set[Change a key of the scene, as in --set particles.count=500]"
        ":KEY=VALUE:__clatter_settings'",
        "'*:SCENE:__clatter_scenes'", "'*:KEY:__clatter_keys'",
        "'1:IN:_files' \\\n    '2:OUT:_files'"}) {
    CAPTURE(line);
    CHECK(says(zsh, std::string("    ") + line));
  }
  CHECK(says(zsh, "]:FIRST\\:END: '"));
  CHECK(
      says(zsh, "_clatter_bench() {\n  local state line\n  typeset -A opt_args\n  _arguments -C "));
  const std::string fish = shell.run("clatter completions fish").out;
  const std::string start = "complete -c clatter -n '__clatter_command_is ";
  for (const char* line :
       {"measure' -l seed -d 'Seed of all random numbers' -r -f\n",
        "measure' -l quiet -d 'Print errors only on stderr'\n",
        "measure' -l progress -d 'Form of the progress on stderr' -r -f -a 'auto json none'\n",
        "measure' -l checkpoint -d 'Keep a checkpoint up to date' -r -F\n",
        "measure' -l csv -d 'Folder for tables of series, profiles and maps' -r -f"
        " -a '(__fish_complete_directories)'\n",
        "measure' -l set -d 'Change a key of the scene, as in --set particles.count=500' -r -f"
        " -a 'schema= title= ",
        "measure' -F -a 'cradle shaker ", "help keys' -f -a 'schema title "}) {
    CAPTURE(line);
    CHECK(says(fish, start + line));
  }
}

}  // namespace clatter
