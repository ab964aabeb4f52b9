#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "app/runs/options.h"
#include "tests/support/shell.h"

namespace clatter {

TEST_CASE("Commands: scenes lists the gallery, one valid scene a line") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter scenes");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(std::ranges::count(outcome.out, '\n') == 17);
  for (const std::string name : {"conduction", "cooling", "dense", "equilibrium", "vibrated"}) {
    CAPTURE(name);
    CHECK(says(("\n" + outcome.out), "\n" + name + " "));
    CHECK(shell.run("clatter check " + name).code == 0);
  }
}

TEST_CASE("Commands: the list of scenes begins with those that explain themselves") {
  const Shell shell;
  const Outcome first = shell.run("clatter scenes | cut -d' ' -f1 | head -3");
  CHECK(first.out == "cradle\nshaker\nvibrated\n");
}

TEST_CASE("Commands: the titles of the list of scenes begin in one column") {
  const Shell shell;
  std::istringstream lines(shell.run("clatter scenes").out);
  const std::size_t column = std::string("spheres_leidenfrost  ").size();
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.find_first_not_of(' ', line.find(' ')) == column);
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

TEST_CASE("Commands: check prints the used and unused features of a scene, and its cost") {
  const Shell shell;
  const std::string plain = shell.run("clatter check equilibrium").err;
  CAPTURE(plain);
  CHECK(says(plain, "\n  feature       bytes per particle  CPU time  in this scene\n"));
  CHECK(std::regex_search(plain, std::regex("\n  particles +[1-9][0-9]* +x1  yes\n")));
  for (const char* part : {"spins", "gravity", "moving walls", "bulk drive", "t_c"}) {
    CAPTURE(part);
    CHECK(std::regex_search(plain, std::regex("\n  " + std::string(part) + " +- +-  no\n")));
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
  CHECK(says(all, ", 200 kicks of all particles; "));
  CHECK(std::regex_search(all, std::regex("\n  spins +8 +x1.05  yes\n")));
  CHECK(std::regex_search(all, std::regex("\n  gravity +0 +x1.15  yes\n")));
  CHECK(std::regex_search(all, std::regex("\n  bulk drive +0 +x[0-9.]+  yes\n")));
  CHECK(std::regex_search(all, std::regex("\n  t_c +8 +x1  yes\n")));
  // Three numbers for each of 100 cells in 66 windows, and in 65 maps. Also three for each of 10
  // columns in 1000 windows.
  CHECK(std::regex_search(all, std::regex("\n  fields +5544 +x1.4  density, velocity\n")));
}

TEST_CASE("Commands: check has the prices of gravity, kicks, walls, balances and snapshots") {
  const Shell shell;
  shell.write("gas.toml",
              "box.size = [10, 10]\n"
              "particles = { count = 25, start.temperature = 3 }\n"
              "walls.left = { kind = \"sawtooth\", stroke = 0.1, frequency = 1 }\n"
              "walls.right = { kind = \"static\" }\n"
              "gravity.acceleration = [-1, 0]\n"
              "bulk_drive = { interval = 0.5, kick_speed = 0.1 }\n");
  const auto checked = [&](const std::string& measure) {
    return shell.run("clatter check gas.toml --until 100 --set 'measure.fields=" + measure).err;
  };
  const auto row = [](const std::string& text, const std::string& feature) {
    std::smatch found;
    std::regex_search(text, found, std::regex("\n  " + feature + " +([0-9]+) +(.*)\n"));
    return found.empty() ? "" : found[2].str();
  };
  // 0.25 disks per unit of area are phi = 0.19635, and chi = 1.4153 (theory 6.1). Enskog's rate
  // (theory 6.2) is 2 sqrt(pi T) 0.25 * 1.4153 = 2.173 per disk. A kick costs 0.45 of a collision
  // of two.
  const std::string balances = checked("[\"balance\"]'");
  CAPTURE(balances);
  CHECK(says(balances, "The scene is valid: 25 disks, area fraction 0.1963."));
  CHECK(says(shell.run("clatter check gas.toml --set particles.count=1").err, ": 1 disk, "));
  CHECK(says(balances, "about 2.72e+03 collisions, 200 kicks"));
  CHECK(row(balances, "bulk drive") == "x1.83  yes");
  CHECK(row(balances, "moving walls") == "x1  yes");
  CHECK(row(balances, "gravity") == "x1.15  yes");
  CHECK(std::regex_search(balances, std::regex("\n  spins +- +-  no\n")));
  CHECK(row(balances, "fields").starts_with("x2  "));
  CHECK(row(checked("[\"balance\",\"density\"]'"), "fields").starts_with("x2.4  "));
  CHECK(row(checked("[\"density\"]' --set measure.estimator=snapshot --set measure.interval=1"),
            "fields") == "x1.1  density");
  CHECK(std::regex_search(checked("[]'"), std::regex("\n  fields +- +-  no\n")));
}

TEST_CASE("Commands: a --set gives its own key, the tables above and the keys below") {
  CommonOptions options;
  options.settings = {"walls.left={kind=\"static\"}", "view.speed=2"};
  for (const char* key : {"walls", "walls.left", "walls.left.kind", "view", "view.speed"}) {
    CAPTURE(key);
    CHECK(options.sets(key));
  }
  for (const char* key : {"walls.lef", "walls.left2", "walls.right", "view.speed_limit", "speed"}) {
    CAPTURE(key);
    CHECK_FALSE(options.sets(key));
  }
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

TEST_CASE("Commands: a scene is read from a pipe") {
  const Shell shell;
  const std::string scene = shell.run("clatter check vibrated").out;
  const Outcome outcome = shell.run("clatter check vibrated | clatter check /dev/stdin");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == scene);
}

TEST_CASE("Commands: output that cannot be written is a failure") {
  const Shell shell;
  for (const std::string line :
       {"clatter scenes >/dev/full", "clatter check vibrated >&-", "clatter --version >/dev/full",
        "clatter measure --help >/dev/full", "clatter measure vibrated --until 501 >/dev/full"}) {
    CAPTURE(line);
    const Outcome outcome = shell.run(line);
    CHECK(outcome.code == 1);
    CHECK(says(outcome.err, "cannot write stdout"));
  }
}

TEST_CASE("Commands: the version is printed, with the commit of a checkout") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter --version");
  CHECK(outcome.code == 0);
  std::smatch found;
  const std::regex version("clatter " CLATTER_VERSION "( \\(commit ([0-9a-f]{12})\\))?\n");
  REQUIRE(std::regex_match(outcome.out, found, version));
  // The program may be older than the last commit of the checkout.
  const std::string git = "git -C " CLATTER_DOCS " rev-parse --verify --quiet ";
  const bool in_checkout = shell.run(git + "HEAD").code == 0;
  CHECK(found[1].matched == in_checkout);
  if (in_checkout) CHECK(shell.run(git + found[2].str() + "^{commit}").code == 0);
}

TEST_CASE("Commands: every command explains its flags, and only those") {
  const Shell shell;
  const std::set<std::string> scene = {"SCENE", "--set", "--seed", "--until"};
  const std::set<std::string> run = {"--quiet", "--progress", "--resume", "--checkpoint",
                                     "--checkpoint-every"};
  const auto with = [](std::set<std::string> flags, const std::set<std::string>& more) {
    flags.insert(more.begin(), more.end());
    return flags;
  };
  const std::map<std::string, std::set<std::string>> commands = {
      {"view",
       with(scene, {"--compare", "--size", "--backend", "--playlist", "--sound", "--script-log"})},
      {"render", with(with(scene, run),
                      {"--out",         "--quality", "--size",        "--fps",     "--from",
                       "--to",          "--speed",   "--supersample", "--shutter", "--no-overlay",
                       "--transparent", "--sound",   "--overwrite",   "--frames",  "--threads",
                       "--backend",     "--join",    "--slurm",       "--time",    "--partition",
                       "--compare",     "--dry-run"})},
      {"measure", with(with(scene, run),
                       {"--out", "--csv", "--vtk", "--hdf5", "--save-state", "--accuracy",
                        "--accuracy-of", "--replicas", "--threads", "--trajectory", "--every",
                        "--events", "--events-of", "--events-in", "--events-share"})},
      {"check", with(scene, {"--quiet"})},
      {"scenes", {}},
      {"bench", {}},
      {"bench engine",
       {"--json", "--count", "--dimension", "--area-fraction", "--volume-fraction"}},
      {"bench cores",
       {"--json", "--count", "--dimension", "--area-fraction", "--threads", "--plot"}},
      {"bench growth", {"--json", "--count", "--plot"}},
      {"bench features", {"--json", "--count"}},
      {"bench fields", {"--json", "--duration"}},
      {"bench render", {"--json", "--count", "--dimension"}},
      {"bench window", {"--json", "--count"}},
      {"bench timeline", {"--json", "--count"}},
      {"bench accuracy",
       {"SCENE", "--json", "--duration", "--dial", "--csv", "--plot", "--markdown"}}};
  for (const auto& [command, flags] : commands) {
    const Outcome outcome = shell.run("clatter " + command + " --help");
    CAPTURE(command);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    std::set<std::string> found;
    const std::regex flag("\n  (?:-\\w,)?(--[-\\w]+|scene SCENE)");
    for (std::sregex_iterator it(outcome.out.begin(), outcome.out.end(), flag), end; it != end;
         ++it) {
      found.insert((*it)[1] == "scene SCENE" ? "SCENE" : (*it)[1].str());
    }
    found.erase("--help");
    CHECK(found == flags);
    const std::size_t space = command.find(' ');
    const bool is_table = space != std::string::npos;
    const std::string list = shell.run(is_table ? "clatter bench --help" : "clatter --help").out;
    CHECK(list.find("\n  " + (is_table ? command.substr(space + 1) : command) + " ") !=
          std::string::npos);
  }
}

TEST_CASE("Commands: a flag that a command does not use is refused") {
  const Shell shell;
  for (const std::string line :
       {"check vibrated --threads 2", "check vibrated --progress none", "scenes --quiet",
        "bench fields --count 5", "bench engine --duration 5", "bench --duration 5",
        "bench engine --area-fraction 0.3", "bench cores --area-fraction 0.3",
        "bench cores --count 1000 --area-fraction 0.3 --dimension 3"}) {
    CAPTURE(line);
    const Outcome outcome = shell.run("clatter " + line);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
  }
}

TEST_CASE("Commands: a quiet check prints the scene only; a seed is reported") {
  const Shell shell;
  const Outcome quiet = shell.run("clatter check vibrated --quiet");
  CHECK(quiet.code == 0);
  CHECK(quiet.err.empty());
  const Outcome outcome = shell.run("clatter check vibrated --seed 7");
  CHECK(outcome.out == quiet.out);
  CHECK(outcome.err.find(", seed 7.\n") != std::string::npos);
}

}  // namespace clatter
