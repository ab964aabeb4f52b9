// Scenes with puffs, with the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

// Spheres, so that profiles and the state of a file have three axes.
const std::string kPuffedSpheres = R"(
box.size = [8.0, 7.0, 6.0]
particles = { count = 50, restitution = 0.9 }
walls.left = { kind = "thermal", temperature = 1.0 }
walls.right = { kind = "static" }
measure = { burn_in = 0.0, fields = ["density"], observables = ["free_flights"], cells = [3, 1, 1] }

[[change]]
time = 5.0
puff = { count = 12, centre = [6.0, 5.0, 1.0], radius = 3.0, temperature = 2.0 }
)";

const std::string kMeasurePuffed = "clatter measure puffed.toml --threads 1 ";

json puffed_result(const Shell& shell, const std::string& name) {
  json result = json::parse(shell.read(name));
  result.erase("performance");
  result["energy"].erase("ledger_residual");
  return result;
}

}  // namespace

TEST_CASE("Puffs: a film and a measurement have the same state, and averages restart") {
  const Shell shell;
  shell.write("puffed.toml", kPuffedSpheres);
  const Outcome measured = shell.run(kMeasurePuffed + "--until 8 --out run.json --csv tables");
  REQUIRE(measured.code == 0);
  CHECK(measured.err.find("averages restart at t = 5") != std::string::npos);
  const json run = json::parse(shell.read("run.json"));
  CHECK(run.at("time").at("measured") == 3.0);
  CHECK(run.at("energy").at("ledger_residual").get<double>() < 1e-12);
  // All cells have the same volume, so that the mean of their densities is that of 62 spheres.
  double density = 0.0;
  for (const json& value : run.at("profile").at("density")) density += value.get<double>() / 3.0;
  CHECK(density == doctest::Approx(62.0 / (8.0 * 7.0 * 6.0)).epsilon(1e-12));
  // The last of these frames is at time 8.
  REQUIRE(shell
              .run("clatter render puffed.toml --speed 1 --fps 4 --to 8.25 --size 160x120 --quiet "
                   "--out film.mkv")
              .code == 0);
  const Outcome tags = shell.run("ffprobe -v error -show_entries format_tags film.mkv");
  CHECK(tags.out.find(run.at("state_hash").get<std::string>()) != std::string::npos);
}

TEST_CASE("Puffs: a run that ends before, at or after one continues to the same result") {
  const Shell shell;
  shell.write("puffed.toml", kPuffedSpheres);
  REQUIRE(shell.run(kMeasurePuffed + "--quiet --until 9 --out whole.json").code == 0);
  for (const char* end : {"4", "5", "6"}) {
    CAPTURE(end);
    REQUIRE(shell.run(kMeasurePuffed + "--quiet --until " + end + " --checkpoint c --out part.json")
                .code == 0);
    REQUIRE(shell.run(kMeasurePuffed + "--quiet --until 9 --resume c --out rest.json").code == 0);
    CHECK(puffed_result(shell, "rest.json").at("state_hash") ==
          puffed_result(shell, "whole.json").at("state_hash"));
  }
  // Averages that restart at the end of the first part have the windows of the whole run.
  REQUIRE(shell.run(kMeasurePuffed + "--quiet --until 5 --checkpoint c --out part.json").code == 0);
  REQUIRE(shell.run(kMeasurePuffed + "--quiet --until 9 --resume c --out rest.json").code == 0);
  CHECK(puffed_result(shell, "rest.json") == puffed_result(shell, "whole.json"));
}

TEST_CASE("Puffs: the number of a start state from a file stays in a checkpoint") {
  const Shell shell;
  shell.write("puffed.toml", kPuffedSpheres);
  REQUIRE(shell
              .run("clatter measure puffed.toml --quiet --set change=[] --until 2 --save-state "
                   "start.csv --out start.json")
              .code == 0);
  const std::string line =
      "clatter measure puffed.toml --quiet --set particles.count=50 --set "
      "particles.start.layout=file --set particles.start.file=start.csv ";
  REQUIRE(shell.run(line + "--until 9 --out whole.json").code == 0);
  REQUIRE(shell.run(line + "--until 6 --checkpoint c --out part.json").code == 0);
  REQUIRE(shell.run(line + "--until 9 --resume c --out rest.json").code == 0);
  CHECK(puffed_result(shell, "rest.json").at("state_hash") ==
        puffed_result(shell, "whole.json").at("state_hash"));
}

TEST_CASE("Puffs: check tells their particles, and a trajectory is refused") {
  const Shell shell;
  shell.write("puffed.toml", kPuffedSpheres);
  const Outcome checked = shell.run("clatter check puffed.toml");
  CHECK(checked.err.find("50 spheres, volume fraction 0.0779; its changes add 12.") !=
        std::string::npos);
  // Closest packing has 0.7405 * 336 / (pi / 6) = 475.2 spheres in this box.
  const auto check_with = [&](const std::string& count) {
    return shell
        .run("clatter check puffed.toml --set 'change=[{ time = 1, puff = { count = " + count +
             ", centre = [4, 4, 3], radius = 9 } }]'")
        .err;
  };
  CHECK(check_with("426").find("beyond the closest packing of 0.7405") != std::string::npos);
  CHECK(check_with("425").find("closest packing") == std::string::npos);
  const Outcome refused =
      shell.run(kMeasurePuffed + "--until 8 --trajectory frames.gsd --every 1 --out run.json");
  CHECK(refused.code == 2);
  CHECK(refused.err.find("--trajectory: all frames of a trajectory have the same particles") !=
        std::string::npos);
  const Outcome full = shell.run(kMeasurePuffed +
                                 "--quiet --until 8 --out run.json --set "
                                 "'change=[{ time = 1, puff = { count = 90, centre = [4, 4, 3], "
                                 "radius = 1 } }]'");
  CHECK(full.code == 3);
  CHECK(full.err.find("the puff at t = 1 has room for ") != std::string::npos);
}

}  // namespace clatter
