// Scenes with nudges, strokes of the piston and puffs, with the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

const std::string kWalled = R"(
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
)";

// A region is heated and a disk is thrown. Much later the region is cooled.
const std::string kNudged = kWalled + R"(
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

const std::string kCompressed = kWalled + R"(
[[change]]
time = 2.0
piston = 14.0
until = 6.0
[[change]]
time = 7.5
piston = 18.0
until = 4000.0
)";

// Spheres, so that profiles and the state of a file have three axes.
const std::string kPuffed = R"(
box.size = [8.0, 7.0, 6.0]
particles = { count = 50, restitution = 0.9 }
walls.left = { kind = "thermal", temperature = 1.0 }
walls.right = { kind = "static" }
measure = { burn_in = 0.0, fields = ["density"], observables = ["free_flights"], cells = [3, 1, 1] }
[[change]]
time = 5.0
puff = { count = 12, centre = [6.0, 5.0, 1.0], radius = 3.0, temperature = 2.0 }
)";

const std::string kMeasureActs = "clatter measure s.toml --threads 1 --quiet ";

json result_of_acts(const Shell& shell, const std::string& name) {
  json result = json::parse(shell.read(name));
  result.erase("performance");
  return result;
}

}  // namespace

TEST_CASE("Acts: a film and a measurement have the same state, and the balances close") {
  for (const std::string& scene : {kNudged, kCompressed, kPuffed}) {
    CAPTURE(scene);
    const Shell shell;
    shell.write("s.toml", scene);
    REQUIRE(shell.run(kMeasureActs + "--until 8 --out run.json").code == 0);
    const json run = result_of_acts(shell, "run.json");
    // The last of these frames is at time 8.
    REQUIRE(shell
                .run("clatter render s.toml --speed 1 --fps 4 --to 8.25 --size 160x120 --quiet "
                     "--out film.mkv")
                .code == 0);
    const Outcome tags = shell.run("ffprobe -v error -show_entries format_tags film.mkv");
    CHECK(says(tags.out, run.at("state_hash").get<std::string>()));
    CHECK(run.at("energy").at("ledger_residual").get<double>() < 1e-12);
    if (scene != kPuffed) {
      for (const char* law : {"mass", "momentum", "energy"}) {
        CHECK(run.at("balance").at(law).get<double>() < 1e-10);
      }
    }
    REQUIRE(shell.run(kMeasureActs + "--until 8 --set change=[] --out quiet.json").code == 0);
    const json quiet = result_of_acts(shell, "quiet.json");
    CHECK(quiet.at("state_hash") != run.at("state_hash"));
    CHECK_FALSE(quiet.at("energy").contains("nudges_in"));
    if (scene == kNudged) CHECK(run.at("energy").at("nudges_in").at("mean").get<double>() > 0.0);
  }
}

TEST_CASE("Acts: a measurement killed before a nudge or in a stroke ends in the same result") {
  for (const std::string& scene : {kNudged, kCompressed}) {
    CAPTURE(scene);
    const Shell shell;
    shell.write("s.toml", scene);
    const std::string line = kMeasureActs + "--until 6000 ";
    REQUIRE(shell.run(line + "--out whole.json").code == 0);
    REQUIRE(cut_off(shell, line + "--out part.json", "KILL").code == 137);
    REQUIRE(shell.run(line + "--resume c --out resumed.json").code == 0);
    CHECK(result_of_acts(shell, "resumed.json") == result_of_acts(shell, "whole.json"));
  }
}

TEST_CASE("Acts: averages restart at a puff, and then include its particles") {
  const Shell shell;
  shell.write("s.toml", kPuffed);
  const Outcome measured =
      shell.run("clatter measure s.toml --threads 1 --until 8 --out run.json --csv tables");
  REQUIRE(measured.code == 0);
  CHECK(says(measured.err, "averages restart at t = 5"));
  const json run = result_of_acts(shell, "run.json");
  CHECK(run.at("time").at("measured") == 3.0);
  // All cells have the same volume, so that the mean of their densities is that of 62 spheres.
  double density = 0.0;
  for (const json& value : run.at("profile").at("density")) density += value.get<double>() / 3.0;
  CHECK(density == doctest::Approx(62.0 / (8.0 * 7.0 * 6.0)).epsilon(1e-12));
}

TEST_CASE("Acts: a run that ends before, at or after a puff continues to the same result") {
  const Shell shell;
  shell.write("s.toml", kPuffed);
  REQUIRE(shell.run(kMeasureActs + "--set change=[] --until 2 --save-state start.csv").code == 0);
  // The checkpoint has the number of particles of a start state from a file.
  const std::string start =
      "--set particles.count=50 --set particles.start.layout=file "
      "--set particles.start.file=start.csv ";
  for (const std::string& flags : {std::string(), start}) {
    const std::string line = kMeasureActs + flags;
    REQUIRE(shell.run(line + "--until 9 --out whole.json").code == 0);
    for (const std::string end : {"4", "5", "6"}) {
      CAPTURE(end);
      REQUIRE(shell.run(line + "--until " + end + " --checkpoint c --out part.json").code == 0);
      REQUIRE(shell.run(line + "--until 9 --resume c --out rest.json").code == 0);
      json whole = result_of_acts(shell, "whole.json"), rest = result_of_acts(shell, "rest.json");
      CHECK(rest.at("state_hash") == whole.at("state_hash"));
      if (end != "5") continue;
      // Averages that restart at the end of the first part have the windows of the whole run.
      for (json* result : {&rest, &whole}) (*result)["energy"].erase("ledger_residual");
      CHECK(rest == whole);
    }
  }
}

TEST_CASE("Acts: check has a note where particles are beyond the closest packing") {
  const Shell shell;
  shell.write("stroke.toml", kCompressed);
  shell.write("puff.toml", kPuffed);
  CHECK(says(shell.run("clatter check puff.toml").err, "0.0779; its changes add 12."));
  const auto is_beyond = [&](const std::string& line) {
    const Outcome outcome = shell.run("clatter check " + line);
    CHECK(outcome.code == 0);
    return says(outcome.err, "closest packing");
  };
  // 60 disks at closest packing need 60 sqrt(3)/2 = 51.96, in this box up to x = 3.7115.
  const std::string stroke = "stroke.toml --set 'change=[{ time = 2, until = 6, piston = ";
  CHECK(is_beyond(stroke + "3.71 }]'"));
  CHECK_FALSE(is_beyond(stroke + "3.72 }]'"));
  // Closest packing has 0.7405 * 336 / (pi / 6) = 475.2 spheres in this box.
  const std::string puff =
      "puff.toml --set 'change=[{ time = 1, puff = { centre = [4, 4, 3], radius = 9, count = ";
  CHECK(is_beyond(puff + "426 } }]'"));
  CHECK_FALSE(is_beyond(puff + "425 } }]'"));
}

TEST_CASE("Acts: without room they end the run, and a trajectory refuses puffs") {
  const Shell shell;
  // A column of four disks is 4 diameters high, or 3.6 in two rows 0.5 apart.
  shell.write("jam.toml",
              "box.size = [6.0, 3.5]\nparticles.count = 4\n"
              "walls = { left.kind = 'static', right.kind = 'static', bottom.kind = 'static', "
              "top.kind = 'static' }\nchange = [{ time = 1.0, piston = 1.4, until = 3.0 }]\n");
  shell.write("s.toml", kPuffed);
  const Outcome jam = shell.run("clatter measure jam.toml --quiet --until 4 --out jam.json");
  CHECK(jam.code == 3);
  CHECK(says(jam.err, "the piston leaves the particles no room"));
  const Outcome full = shell.run(kMeasureActs +
                                 "--until 8 --set 'change=[{ time = 1, puff = { count = 90, "
                                 "centre = [4, 4, 3], radius = 1 } }]'");
  CHECK(full.code == 3);
  CHECK(says(full.err, "the puff at t = 1 has room for "));
  check_refused(shell, kMeasureActs + "--until 8 --trajectory frames.gsd --every 1",
                {"--trajectory", "same particles"});
}

}  // namespace clatter
