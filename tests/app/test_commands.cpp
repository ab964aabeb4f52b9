#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "app/runs/options.h"
#include "tests/support/shell.h"

namespace clatter {

TEST_CASE("Commands: scenes lists the gallery, one valid scene a line, with titles in a column") {
  const Shell shell;
  const Outcome outcome = shell.run("clatter scenes");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(std::ranges::count(outcome.out, '\n') == 33);
  // The first scenes explain themselves.
  CHECK(shell.run("clatter scenes | cut -d' ' -f1 | head -3").out == "cradle\nshaker\nvibrated\n");
  const std::size_t column = std::string("spheres_leidenfrost  ").size();
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = line.find(' ');
    CHECK(line.find_first_not_of(' ', space) == column);
    CHECK(shell.run("clatter check " + line.substr(0, space)).code == 0);
  }
}

TEST_CASE("Commands: check prints the used and unused features of a scene, and its cost") {
  const Shell shell;
  const std::string plain = shell.run("clatter check equilibrium").err;
  CAPTURE(plain);
  CHECK(std::regex_search(plain, std::regex("\n  particles +[1-9][0-9]* +x1  yes\n")));
  for (const std::string part : {"spins", "gravity", "moving walls", "bulk drive", "t_c"}) {
    CAPTURE(part);
    CHECK(std::regex_search(plain, std::regex("\n  " + part + " +- +-  no\n")));
  }
  const std::string all =
      shell
          .run(
              "clatter check rough_driven --set collapse.contact_time=1e-6 --until 100 "
              "--set measure.cells=[10,10] --set 'measure.fields=[\"density\",\"velocity\"]' "
              "--set particles.count=100")
          .err;
  CAPTURE(all);
  CHECK(std::regex_search(all, std::regex("\n  spins +8 +x1.05  yes\n")));
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

TEST_CASE("Commands: check prints a scene that it reads from a pipe and prints again unchanged") {
  const Shell shell;
  for (const std::string scene :
       {"vibrated", "cooling --set 'title=\"a \\\"b\\\" \\\\ 气体 ρ\"'", "dense"}) {
    CAPTURE(scene);
    const Outcome outcome =
        shell.run("clatter check " + scene + " > a.toml; cat a.toml | clatter check /dev/stdin");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out == shell.read("a.toml"));
    CHECK(outcome.out.size() > 100);
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
