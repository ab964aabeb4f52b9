// Trajectories of sheared boxes, read by the programs of their formats.

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/readers.h"
#include "tests/support/messages.h"
#include "tests/support/shell.h"

namespace clatter::shear_files {

using nlohmann::json;
using namespace clatter::testing;

// The image above slides at 0.7 * 9 = 6.3, so it passes the length 12 after 1.9 time units.
constexpr const char* kScene = R"(
box.size = [12, 9]
particles = { count = 30, restitution = 0.9 }
measure = { burn_in = 1.0, duration = 40.0 }
shear.rate = 0.7
)";

static void measure(const Shell& shell, const std::string& file, const std::string& flags) {
  const Outcome outcome = shell.run("clatter measure s.toml --quiet --out r.json --trajectory " +
                                    file + " --every 0.5 " + flags);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
}

// Positions are in the tilted cell. Collisions conserve momentum, also between frames that have
// different flows, so the centre of mass of the unwrapped positions moves straight on. A lost image
// would move it by 12/30 or 9/30.
TEST_CASE("Shear files: readers have the tilted cell, and unwrapped positions move on") {
  const Shell shell;
  shell.write("s.toml", kScene);
  for (const std::string format : {"xyz", "lammpstrj", "csv", "gsd", "h5md", "vtp"}) {
    CAPTURE(format);
    const std::string file = "t." + format;
    measure(shell, file, "");
    const json frames = read_by(shell, "read_tilted.py", file);
    REQUIRE(frames.size() == 83);
    // Single precision of two frames limits the speed, and so a path of 80 times their distance.
    const double rounding = format == "gsd" || format == "lammpstrj" ? 1e-5 : 1e-12;
    const auto centre = [&](std::size_t frame, std::size_t axis) {
      double sum = 0.0;
      for (const json& position : frames[frame]["unwrapped"]) sum += double{position[axis]} / 30.0;
      return sum;
    };
    for (std::size_t k = 0; k < frames.size(); ++k) {
      CAPTURE(k);
      const double time = 0.5 * static_cast<double>(k);
      const json& cell = frames[k]["cell"];
      const double tilt = cell[1][0];
      CHECK(double{cell[0][0]} == doctest::Approx(12.0));
      CHECK(double{cell[1][1]} == doctest::Approx(9.0));
      CHECK(std::fabs(std::remainder(tilt - 6.3 * time, 12.0)) < 10.0 * rounding);
      CHECK(std::fabs(tilt) <= 6.0 + rounding);
      for (const json& position : frames[k]["positions"]) {
        const double up = double{position[1]} / 9.0;
        const double along = (double{position[0]} - tilt * up) / 12.0;
        CHECK((up >= -rounding && up <= 1.0 + rounding));
        CHECK((along >= -rounding && along <= 1.0 + rounding));
      }
      if (!frames[k].contains("unwrapped")) continue;
      CHECK(double{frames[k]["time"]} == doctest::Approx(time));
      for (const std::size_t axis : {0u, 1u}) {
        const double speed = (centre(1, axis) - centre(0, axis)) / 0.5;
        CHECK(centre(k, axis) - centre(0, axis) ==
              doctest::Approx(speed * time).scale(1.0).epsilon(1e3 * rounding));
      }
    }
  }
}

TEST_CASE("Shear files: what a tilted cell does not fit refuses it") {
  const Shell shell;
  shell.write("s.toml", kScene);
  for (const std::string format : {"xyz", "lammpstrj", "csv", "gsd", "h5md", "vtp"}) {
    CAPTURE(format);
    measure(shell, "t." + format, "--until 1");
    const std::string file =
        format == "vtp" ? "t_000002.vtp start.csv" : "t." + format + " start.csv --frame 2";
    const Outcome outcome = shell.run("clatter convert " + file);
    CHECK(outcome.code == 2);
    CHECK(says(outcome.err, "the box is tilted"));
  }
  shell.write("plain.toml", std::string(kScene).replace(std::string(kScene).find("shear"), 16, ""));
  const std::string run = "clatter measure plain.toml --quiet --out r.json --every 0.5 ";
  REQUIRE(shell.run(run + "--trajectory p.csv --until 2 --checkpoint c").code == 0);
  const Outcome outcome = shell.run(run + "--trajectory p.csv --resume c --set shear.rate=0.1");
  CHECK(outcome.code == 2);
  CHECK(says(outcome.err, "has no tilted cell"));
}

TEST_CASE("Shear files: an interrupted run continues them to the byte") {
  const Shell shell;
  shell.write("s.toml", kScene);
  for (const std::string format : {"csv", "gsd", "h5md"}) {
    CAPTURE(format);
    measure(shell, "whole." + format, "");
    measure(shell, "part." + format, "--until 13 --checkpoint c.checkpoint");
    measure(shell, "part." + format, "--resume c.checkpoint");
    CHECK(shell.read("part." + format) == shell.read("whole." + format));
  }
}

}  // namespace clatter::shear_files
