// Scenes with a piston, with the command line.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

const std::string kCompressed = R"(
schema = 1
box.size = [20.0, 14.0]
particles.count = 60
particles.restitution = 0.9
gravity.acceleration = [0.0, -0.5]
walls.left = { kind = "thermal", temperature = 1.0 }
walls.right = { kind = "static" }
walls.bottom = { kind = "driven", drive_speed = 1.0 }
walls.top = { kind = "static", restitution = 0.8 }
measure = { burn_in = 0.0, fields = ["balance"], cells = [3, 5] }

[[change]]
time = 2.0
piston = 14.0
until = 6.0

[[change]]
time = 7.5
piston = 18.0
until = 4000.0
)";

const std::string kMeasureCompressed = "clatter measure piston.toml --quiet ";

json compressed_result(const Shell& shell, const std::string& name) {
  json result = json::parse(shell.read(name));
  result.erase("performance");
  return result;
}

}  // namespace

TEST_CASE("Piston: a film and a measurement have the same state, and the balances close") {
  const Shell shell;
  shell.write("piston.toml", kCompressed);
  REQUIRE(shell.run(kMeasureCompressed + "--until 8 --out run.json").code == 0);
  const json run = compressed_result(shell, "run.json");
  // The last of these frames is at time 8.
  REQUIRE(shell
              .run("clatter render piston.toml --speed 1 --fps 4 --to 8.25 --size 160x120 --quiet "
                   "--out film.mkv")
              .code == 0);
  const Outcome tags = shell.run("ffprobe -v error -show_entries format_tags film.mkv");
  CHECK(tags.out.find(run.at("state_hash").get<std::string>()) != std::string::npos);
  CHECK(run.at("energy").at("ledger_residual").get<double>() < 1e-12);
  for (const char* law : {"mass", "momentum", "energy"}) {
    CHECK(run.at("balance").at(law).get<double>() < 1e-10);
  }
  REQUIRE(shell.run(kMeasureCompressed + "--until 8 --set change=[] --out rest.json").code == 0);
  CHECK(compressed_result(shell, "rest.json").at("state_hash") != run.at("state_hash"));
}

TEST_CASE("Piston: a measurement killed during a stroke ends in the same result") {
  const Shell shell;
  shell.write("piston.toml", kCompressed);
  const std::string line = kMeasureCompressed + "--until 5000 ";
  REQUIRE(shell.run(line + "--out whole.json").code == 0);
  REQUIRE(cut_off(shell, line + "--out part.json", "KILL").code == 137);
  REQUIRE(shell.run(line + "--resume c --out resumed.json").code == 0);
  CHECK(compressed_result(shell, "resumed.json") == compressed_result(shell, "whole.json"));
}

TEST_CASE("Piston: check refuses a stroke at its place, and notes one beyond closest packing") {
  const Shell shell;
  shell.write("piston.toml", kCompressed);
  const Outcome early = shell.run(
      "sed 's/time = 7.5/time = 5.5/' piston.toml >early.toml && clatter check early.toml");
  CHECK(early.code == 2);
  CHECK(early.err.find("early.toml:19:1:") != std::string::npos);
  CHECK(early.err.find("has ended") != std::string::npos);
  // 60 disks at closest packing need 60 sqrt(3)/2 = 51.96, in this box up to x = 3.7115.
  const auto check_to = [&](const std::string& position) {
    const Outcome outcome = shell.run("sed 's/piston = 14.0/piston = " + position +
                                      "/' piston.toml >far.toml && clatter check far.toml");
    CHECK(outcome.code == 0);
    return outcome.err;
  };
  CHECK(check_to("3.71").find("beyond the closest packing of 0.9069") != std::string::npos);
  CHECK(check_to("3.72").find("closest packing") == std::string::npos);
  // A column of four disks is 4 diameters high, or 3.6 in two rows 0.5 apart.
  shell.write("jam.toml",
              "box.size = [6.0, 3.5]\nparticles.count = 4\n"
              "walls = { left.kind = 'static', right.kind = 'static', bottom.kind = 'static', "
              "top.kind = 'static' }\nchange = [{ time = 1.0, piston = 1.4, until = 3.0 }]\n");
  const Outcome jammed = shell.run("clatter measure jam.toml --quiet --until 4 --out jam.json");
  CHECK(jammed.code == 3);
  CHECK(jammed.err.find("the piston leaves the particles no room") != std::string::npos);
}

}  // namespace clatter
