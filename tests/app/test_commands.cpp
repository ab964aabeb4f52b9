#include <doctest/doctest.h>

#include <algorithm>
#include <regex>

#include "tests/app/shell.h"

namespace clatter {

TEST_CASE("Commands: scenes lists the gallery, one valid scene a line") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter scenes");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(std::ranges::count(outcome.out, '\n') == 12);
  for (const std::string name : {"conduction", "cooling", "dense", "equilibrium", "vibrated"}) {
    CAPTURE(name);
    CHECK(says(("\n" + outcome.out), "\n" + name + " "));
    CHECK(shell.run("clatter check " + name).code == 0);
  }
}

TEST_CASE("Commands: check prints a scene that it prints again unchanged") {
  const Shell shell;
  for (const std::string scene :
       {"vibrated", "cooling --set 'title=\"a \\\"b\\\" \\\\ ü\"'", "conduction", "dense"}) {
    CAPTURE(scene);
    const Outcome outcome = shell.run("clatter check " + scene + " > a.toml; clatter check a.toml");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out == shell.read("a.toml"));
    CHECK(outcome.out.size() > 100);
  }
}

TEST_CASE("Commands: check says what a scene models, what not, and how much it computes") {
  const Shell shell;
  const std::string plain = shell.run("clatter check cooling --quiet").err;
  CAPTURE(plain);
  for (const char* part : {"spins", "gravity", "moving walls", "bulk drive", "t_c"}) {
    CAPTURE(part);
    CHECK(std::regex_search(plain,
                            std::regex("\n  " + std::string(part) + " +0 +(x[0-9.]+|-)  no\n")));
  }
  CHECK_FALSE(says(plain, "kicks"));
  const std::string all =
      shell
          .run(
              "clatter check rough_driven --set collapse.contact_time=1e-6 --until 100 "
              "--set gravity.acceleration=[0,-1] --set bulk_drive.interval=0.5 "
              "--set measure.cells=[10,10] --set 'measure.fields=[\"density\",\"velocity\"]' "
              "--set particles.count=100")
          .err;
  CAPTURE(all);
  CHECK(says(all, ", 200 kicks of all disks; "));
  CHECK(std::regex_search(all, std::regex("\n  spins +8 +x1.05  yes\n")));
  CHECK(std::regex_search(all, std::regex("\n  gravity +0 +x1.15  yes\n")));
  CHECK(std::regex_search(all, std::regex("\n  bulk drive +0 +x[0-9.]+  yes\n")));
  CHECK(std::regex_search(all, std::regex("\n  t_c +8 +x1  yes\n")));
  // Three numbers for each of 100 cells in 66 windows, and in 65 maps; and for each of 10 columns
  // in 1000 windows.
  CHECK(std::regex_search(all, std::regex("\n  fields +5544 +x1.4  density, velocity\n")));
}

TEST_CASE("Commands: a flag wins over the scene") {
  const Shell shell;
  const Outcome outcome = shell.run(
      "clatter check vibrated --set particles.count=50 --set view.overlay=false --set title=Mine "
      "--set box.size=[30,40] --set particles.start.layout=lattice");
  CHECK(outcome.code == 0);
  for (const char* line :
       {"count = 50\n", "overlay = false\n", "title = \"Mine\"\n", "layout = \"lattice\"\n"}) {
    CAPTURE(line);
    CHECK(says(outcome.out, line));
  }
}

TEST_CASE("Commands: scenes with a title of any script and lines of any ending are read") {
  const Shell shell;
  shell.write("s.toml", "title = \"气体 ρ\"\r\ncaption = \"\"\r\n[particles]\r\ncount = 3\r\n");
  const Outcome outcome = shell.run("clatter check s.toml");
  CHECK(outcome.code == 0);
  CHECK(says(outcome.out, "title = \"气体 ρ\"\n"));
  CHECK(says(outcome.out, "caption = \"\"\n"));
}

TEST_CASE("Commands: output that cannot be written is a failure") {
  const Shell shell;
  for (const std::string line : {"clatter scenes >/dev/full", "clatter check vibrated >&-",
                                 "clatter measure vibrated --until 501 >/dev/full"}) {
    CAPTURE(line);
    const Outcome outcome = shell.run(line);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot write stdout"));
  }
}

TEST_CASE("Commands: the version is printed") {
  const Outcome outcome = Shell().run("clatter --version");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "clatter " CLATTER_VERSION "\n");
}

TEST_CASE("Commands: every command explains each of its flags") {
  const Shell shell;
  const std::vector<std::string> common = {"SCENE",     "--set",   "--seed",    "--until",
                                           "--threads", "--quiet", "--progress"};
  struct Command {
    std::string name;
    bool has_scene;
    std::vector<std::string> flags;
  };
  for (const Command& command : {
           Command{"render",
                   true,
                   {"--out", "--size", "--fps", "--from", "--to", "--speed", "--no-overlay",
                    "--supersample", "--quality", "--overwrite", "--backend", "--resume",
                    "--checkpoint", "--checkpoint-every"}},
           Command{"measure",
                   true,
                   {"--resume", "--checkpoint", "--out", "--csv", "--save-state", "--accuracy",
                    "--accuracy-of", "--replicas"}},
           Command{"check", true, {}},
           Command{"scenes", false, {}},
           Command{"bench",
                   false,
                   {"--json", "--count", "--area-fraction", "--duration", "--dial", "--csv",
                    "--plot", "--markdown"}},
       }) {
    const Outcome outcome = shell.run("clatter " + command.name + " --help");
    CAPTURE(command.name);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    std::vector<std::string> flags = command.flags;
    if (command.has_scene) flags.insert(flags.end(), common.begin(), common.end());
    for (const std::string& flag : flags) {
      CAPTURE(flag);
      CHECK(says(outcome.out, flag));
    }
    CHECK(says(shell.run("clatter --help").out, "\n  " + command.name + " "));
  }
}

}  // namespace clatter
