#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/shell.h"

namespace clatter {

using nlohmann::json;

namespace {

// Elastic rough disks without walls, with translations of temperature 1 and spins of 2.
const std::string kRough =
    "box.size = [12, 12]\n"
    "particles = { count = 40, restitution = 1.0, tangential_restitution = 0.5, "
    "start = { temperature = 1.0, spin_temperature = 2.0 } }\n"
    "measure = { burn_in = 0, duration = 20, series_interval = 1, fields = [] }\n";
json measured(const Shell& shell, const std::string& scene, const std::string& flags = "") {
  shell.write("scene.toml", scene);
  const Outcome outcome =
      shell.run("clatter measure scene.toml --quiet --out r.json --save-state s.csv " + flags);
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  return json::parse(shell.read("r.json"));
}

// The mean of the squares of some columns of the saved state, which has one line per particle.
double mean_square(const Shell& shell, const std::vector<int>& columns) {
  std::istringstream lines(shell.read("s.csv"));
  std::string line;
  std::getline(lines, line);
  double sum = 0.0, count = 0.0;
  for (; std::getline(lines, line); ++count) {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; std::getline(cells, cell, ','); ++column) {
      for (const int wanted : columns) sum += wanted == column ? std::pow(std::stod(cell), 2) : 0.0;
    }
  }
  return sum / count;
}

}  // namespace

TEST_CASE("Changed laws: smooth contacts keep the spins, and rough ones change them again") {
  const Shell shell;
  const json result = measured(shell, kRough + R"(
[[change]]
time = 5
set = { "particles.tangential_restitution" = -1.0 }
[[change]]
time = 15
set = { "particles.tangential_restitution" = 0.5 }
)");
  const json& series = result.at("temperature_series");
  const std::vector<double> spin = series.at("spin"), motion = series.at("translational");
  REQUIRE(series.at("time").size() == 21);
  REQUIRE(motion.size() == 21);
  REQUIRE(spin.size() == 21);
  CHECK(result.at("time").at("burn_in") == 0.0);  // averages do not restart
  CHECK(spin[0] == doctest::Approx(2.0).epsilon(1e-12));
  CHECK(spin[4] != spin[0]);
  CHECK(spin[5] > 0.1);
  for (std::size_t k = 6; k <= 15; ++k) {
    CHECK(spin[k] == spin[5]);
    CHECK(motion[k] == doctest::Approx(motion[5]).epsilon(1e-12));
  }
  CHECK(spin[20] != spin[15]);
  // The energies of the state: T = <v^2>/2, and T_rot = I <omega^2> with I = 1/8.
  CHECK(motion[20] == doctest::Approx(mean_square(shell, {2, 3}) / 2.0).epsilon(1e-12));
  CHECK(spin[20] == doctest::Approx(mean_square(shell, {4}) / 8.0).epsilon(1e-12));
  CHECK(result.at("energy").at("ledger_residual") < 1e-12);
}

TEST_CASE("Changed laws: spins begin at zero where contacts become rough") {
  const Shell shell;
  const std::string scene =
      "box.size = [12, 12]\nparticles = { count = 40, restitution = 1.0 }\n"
      "measure = { burn_in = 0, duration = 20, series_interval = 1, fields = [] }\n"
      "[[change]]\ntime = 5\nset = { \"particles.tangential_restitution\" = 0.5 }\n";
  const json result = measured(shell, scene);
  const std::vector<double> spin = result.at("temperature_series").at("spin");
  REQUIRE(spin.size() == 21);
  for (std::size_t k = 0; k <= 5; ++k) CHECK(spin[k] == 0.0);
  CHECK(spin[20] == doctest::Approx(mean_square(shell, {4}) / 8.0).epsilon(1e-12));
  CHECK(spin[20] > 0.05);
  CHECK(result.at("energy").at("ledger_residual") < 1e-12);
}

TEST_CASE("Changed laws: another inertia changes the energy of spins, not the residual") {
  const Shell shell;
  const json result =
      measured(shell, kRough + "[[change]]\ntime = 5\nset = { \"particles.inertia\" = 0.25 }\n");
  CHECK(result.at("energy").at("ledger_residual") < 1e-12);
  const std::vector<double> spin = result.at("temperature_series").at("spin");
  CHECK(spin[20] == doctest::Approx(mean_square(shell, {4}) / 16.0).epsilon(1e-12));
}

// Gravity along a periodic axis adds energy to all particles.
TEST_CASE("Changed laws: series and energy balance go on under another gravity") {
  const Shell shell;
  const std::string scene =
      kRough +
      "gravity.acceleration = [0.1, 0.0]\n"
      "[[change]]\ntime = 5\nset = { \"gravity.acceleration\" = [0.0, -0.3] }\n"
      "[[change]]\ntime = 10\nset = { \"gravity.acceleration\" = [0.0, 0.0] }\n";
  const json result = measured(shell, scene);
  const json& series = result.at("temperature_series");
  REQUIRE(series.at("time").size() == 21);
  CHECK(series.at("time")[0] == 0.0);
  CHECK(series.at("translational").size() == 21);
  CHECK(series.at("spin").size() == 21);
  // Averages restart at a change of gravity. The residual compares with the energy at t = 0.
  CHECK(result.at("time").at("burn_in") == 10.0);
  CHECK(result.at("energy").at("ledger_residual") < 1e-12);
}

TEST_CASE("Changed laws: what a law does is in the result, wherever it begins or ends") {
  const Shell shell;
  const std::string scene =
      "box.size = [12, 12]\nparticles = { count = 40, restitution = 0.9 }\n"
      "measure = { burn_in = 0, duration = 20, series_interval = 1, fields = [] }\n"
      "bulk_drive = { interval = 0.1, kick_speed = 0.2 }\n"
      "[[change]]\ntime = 10\nset = { \"collapse.contact_time\" = 0.05 }\n"
      "[[change]]\ntime = 15\nset = { \"bulk_drive.kick_speed\" = 0.0 }\n";
  const json result = measured(shell, scene);
  CHECK(result.at("energy").at("bulk_in").at("mean") > 0.0);
  CHECK(result.at("events").at("kicks") >= 100);
  CHECK(result.at("events").at("elasticised") > 0);
  CHECK(result.at("checks").at("undissipated_share") > 0.0);
}

TEST_CASE("Changed laws: an elastic gas dissipates exactly nothing") {
  const Shell shell;
  for (const char* const particles :
       {"count = 40, restitution = 1.0",
        "count = 40, restitution = 1.0, tangential_restitution = 1.0",
        "count = 40, restitution = 1.0, tangential_restitution = -1.0"}) {
    CAPTURE(particles);
    const json result =
        measured(shell,
                 "box.size = [12, 12]\nmeasure = { burn_in = 0, duration = 20, fields = [] }\n"
                 "particles = { " +
                     std::string(particles) + " }\n");
    CHECK(result.at("energy").at("dissipated").at("mean") == 0.0);
    CHECK(result.at("energy").at("dissipated").at("standard_error") == 0.0);
  }
}

}  // namespace clatter
