// Scenes with nudges, with the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

// A region is heated and a disk is thrown. Much later the region is cooled.
const std::string kNudged = R"(
schema = 1
box.size = [20.0, 14.0]
particles.count = 60
particles.restitution = 0.9
particles.start.layout = "random"
gravity.acceleration = [0.0, -0.5]
walls.left = { kind = "thermal", temperature = 1.0 }
walls.right = { kind = "static" }
walls.bottom = { kind = "driven", drive_speed = 1.0 }
walls.top = { kind = "static", restitution = 0.8 }
measure = { burn_in = 0.0, fields = ["balance"], cells = [3, 5] }

[[change]]
time = 5.0
set = { "particles.restitution" = 0.8 }
nudge = { centre = [6.0, 5.0], radius = 4.0, scale = 3.0 }

[[change]]
time = 5.0
nudge = { particle = 17, set = [-4.0, 2.0] }

[[change]]
time = 4000.0
nudge = { centre = [6.0, 5.0], radius = 4.0, scale = 0.5 }
)";

const std::string kMeasureNudged = "clatter measure nudged.toml --quiet ";

json nudged_result(const Shell& shell, const std::string& name) {
  json result = json::parse(shell.read(name));
  result.erase("performance");
  return result;
}

}  // namespace

TEST_CASE("Nudges: a film and a measurement have the same state, and other than without") {
  const Shell shell;
  shell.write("nudged.toml", kNudged);
  REQUIRE(shell.run(kMeasureNudged + "--until 8 --out run.json").code == 0);
  const json run = nudged_result(shell, "run.json");
  // The last of these frames is at time 8.
  REQUIRE(shell
              .run("clatter render nudged.toml --speed 1 --fps 4 --to 8.25 --size 160x120 --quiet "
                   "--out film.mkv")
              .code == 0);
  const Outcome tags = shell.run("ffprobe -v error -show_entries format_tags film.mkv");
  CHECK(tags.out.find(run.at("state_hash").get<std::string>()) != std::string::npos);

  CHECK(run.at("energy").at("nudges_in").at("mean").get<double>() > 0.0);
  CHECK(run.at("energy").at("ledger_residual").get<double>() < 1e-12);
  for (const char* law : {"mass", "momentum", "energy"}) {
    CHECK(run.at("balance").at(law).get<double>() < 1e-10);
  }
  REQUIRE(shell.run(kMeasureNudged + "--until 8 --set change=[] --out quiet.json").code == 0);
  const json quiet = nudged_result(shell, "quiet.json");
  CHECK(quiet.at("state_hash") != run.at("state_hash"));
  CHECK_FALSE(quiet.at("energy").contains("nudges_in"));
}

TEST_CASE("Nudges: a killed measurement ends in the same result") {
  const Shell shell;
  shell.write("nudged.toml", kNudged);
  const std::string line = kMeasureNudged + "--until 8000 ";
  REQUIRE(shell.run(line + "--out whole.json").code == 0);
  REQUIRE(cut_off(shell, line + "--out part.json", "KILL").code == 137);
  REQUIRE(shell.run(line + "--resume c --out resumed.json").code == 0);
  CHECK(nudged_result(shell, "resumed.json") == nudged_result(shell, "whole.json"));
}

TEST_CASE("Nudges: an impossible one is refused at its place") {
  const Shell shell;
  shell.write("nudged.toml", kNudged);
  const Outcome outcome = shell.run(
      "sed 's/particle = 17/particle = 60/' nudged.toml >far.toml && clatter check far.toml");
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("far.toml:21:11:") != std::string::npos);
  CHECK(outcome.err.find("there is no particle 60") != std::string::npos);
}

}  // namespace clatter
