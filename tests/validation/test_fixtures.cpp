// Gases among fixtures against exact results.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/measure/measurement.h"
#include "engine/scene/scene_file.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

namespace clatter::fixture_physics {

using namespace testing;

namespace {

constexpr double kPi = std::numbers::pi;

Measured measured(const std::string& text, double burn_in, double duration, std::uint64_t seed) {
  return run(parse_scene(text, ""), burn_in, duration, seed);
}

/// Checks the hits of one particle on fixtures whose surfaces, and the room of its centre, are
/// known, in 60 independent runs. The motion is ergodic: the rate on a surface S is S v/(pi A) in
/// 2D and S v/(4 V) in 3D.
void check_billiard(const std::string& text, const std::vector<double>& surfaces, double room,
                    int dimension) {
  std::vector<Sample> lengths(surfaces.size());  // hits per length of the path
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Measured result = measured(text, 10.0, 2000.0, seed);
    REQUIRE(result.fixtures.size() == surfaces.size());
    const double speed = std::sqrt(dimension * result.temperature.mean);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      lengths[k].add(result.fixtures[k].hits.at(0).second.mean / speed);
    }
  }
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    CAPTURE(k);
    const double expected = surfaces[k] / ((dimension == 2 ? kPi : 4.0) * room);
    const double mean = lengths[k].mean(), error = lengths[k].standard_error();
    CHECK(error < 0.02 * mean);
    CHECK(std::fabs(mean - expected) < 4.0 * error);
    MESSAGE("hits per length " << mean << "(" << error << "), expected " << expected);
  }
}

}  // namespace

// The surface on which centres touch is the one at the distance a = 1/2: a polygon of perimeter P
// and area A has P + 2 pi a and A + P a + pi a^2.
TEST_CASE("Fixture physics: one disk hits each body in proportion to its surface") {
  const double a = 0.5, ball = 1.5, perimeter = 2.0 + 2.0 * std::hypot(1.0, 2.0);
  const double segments = 1.0 + 1.8 + 1.5;  // of the partition, with four ends
  const double covered = kPi * (ball + a) * (ball + a) + (2.0 + perimeter * a + kPi * a * a) +
                         (2.0 * a * segments + 2.0 * kPi * a * a);
  check_billiard(
      R"(
box.size = [13.0, 7.0]
particles.count = 1
[[obstacle]]
kind = "ball"
centre = [12.8, 3.0]
radius = 1.5
[[obstacle]]
kind = "polygon"
corners = [[8.0, 2.0], [9.0, 4.0], [7.0, 4.0]]
[[partition]]
axis = "x"
position = 4.0
holes = [{ from = [1.0], to = [2.2] }, { from = [4.0], to = [5.5] }]
)",
      {2.0 * kPi * (ball + a), perimeter + 2.0 * kPi * a, 2.0 * segments + 4.0 * kPi * a},
      91.0 - covered, 2);
}

// Steiner's formulas of a cuboid with the sum of edges L: S + 2 pi a L + 4 pi a^2 and
// V + S a + pi L a^2 + (4/3) pi a^3.
TEST_CASE("Fixture physics: one sphere hits each body in proportion to its surface") {
  const double a = 0.5, ball = 1.0, edges = 1.0 + 2.0 + 1.5;
  const double sides = 2.0 * (2.0 + 3.0 + 1.5), volume = 3.0;
  const double covered = 4.0 / 3.0 * kPi * std::pow(ball + a, 3.0) + volume + sides * a +
                         kPi * edges * a * a + 4.0 / 3.0 * kPi * std::pow(a, 3.0);
  check_billiard(
      R"(
box.size = [6.0, 5.5, 5.0]
particles.count = 1
[[obstacle]]
kind = "ball"
centre = [1.5, 0.2, 2.0]
radius = 1.0
[[obstacle]]
kind = "box"
from = [3.5, 2.5, 3.0]
to = [4.5, 4.5, 4.5]
)",
      {4.0 * kPi * (ball + a) * (ball + a), sides + 2.0 * kPi * a * edges + 4.0 * kPi * a * a},
      165.0 - covered, 3);
}

// A closed body feels no mean force in an elastic gas in equilibrium, whatever its shape: five
// independent runs, and chi^2 of all components.
TEST_CASE("Fixture physics: an elastic gas exerts no mean force on closed bodies") {
  const std::string bodies = R"(
box.size = [14.0, 12.0]
particles.count = 60
[[obstacle]]
kind = "polygon"
corners = [[3.0, 2.0], [7.0, 2.5], [4.5, 3.0], [4.0, 6.0]]
[[obstacle]]
kind = "ball"
centre = [10.0, 8.0]
radius = 1.5
)";
  double chi_squared = 0.0, freedom = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const FixtureMeans& fixture : measured(bodies, 20.0, 1000.0, seed).fixtures) {
      for (const Estimate& force : fixture.force) {
        const double off = force.mean / force.standard_error;
        CHECK(std::fabs(off) < 5.0);
        // The pressure on one side alone would be about N T / A times the width: over 1.
        CHECK(force.standard_error < 0.1);
        chi_squared += off * off;
        freedom += 1.0;
      }
      CHECK(std::fabs(fixture.power.mean) < 1e-12);
    }
  }
  CHECK(chi_squared_p(chi_squared, freedom) > kMinProbability);
}

// Emission from oblique and curved surfaces: the gas takes their temperature along each axis, of
// motion and of spins.
TEST_CASE("Fixture physics: thermal bodies bring a gas to their temperature") {
  for (const char* const text : {R"(
box.size = [10.0, 9.0]
particles = { count = 25, tangential_restitution = 1.0 }
[[obstacle]]
kind = "polygon"
corners = [[3.0, 2.0], [6.0, 3.0], [4.0, 5.0]]
temperature = 1.7
)",
                                 R"(
box.size = [6.0, 6.0, 6.0]
particles = { count = 25, tangential_restitution = 1.0 }
[[obstacle]]
kind = "ball"
centre = [3.0, 3.0, 3.0]
radius = 1.2
temperature = 1.7
)"}) {
    CAPTURE(text);
    const Measured result = measured(text, 200.0, 4000.0, 4);
    std::vector<Estimate> temperatures = result.axis_temperatures;
    temperatures.push_back(*result.spin_temperature);
    for (const Estimate& one : temperatures) {
      CHECK(relative_error(one) < 0.02);
      CHECK(std::fabs(one.mean - 1.7) < 4.0 * one.standard_error);
    }
  }
}

// Effusion: the compartments exchange particles at rates n sqrt(T), and rest when both are equal.
// Few particles, so that they rarely meet on the way through the hole.
TEST_CASE("Fixture physics: effusion through a small hole") {
  const Measured result = measured(R"(
box.size = [60.0, 30.0]
particles.count = 20
walls.left = { kind = "thermal", temperature = 4.0 }
walls.right = { kind = "thermal", temperature = 1.0 }
walls.bottom.kind = "static"
walls.top.kind = "static"
[[partition]]
axis = "x"
position = 30.0
holes = [{ from = [13.0], to = [17.0] }]
)",
                                   2000.0, 60000.0, 2);
  REQUIRE(result.compartments.has_value());
  const CompartmentMeans& sides = *result.compartments;
  const double left = sides.share_left.mean, error = sides.share_left.standard_error;
  const double hot = sides.temperature_left->mean, cold = sides.temperature_right->mean;
  const double expected = 1.0 / (1.0 + std::sqrt(hot / cold));
  MESSAGE("share " << left << "(" << error << "), expected " << expected << " at T = " << hot
                   << " and " << cold);
  CHECK(hot > 2.0 * cold);
  CHECK(error < 0.01);
  CHECK(std::fabs(left - expected) < 4.0 * error);
  CHECK(sides.count_left.mean == doctest::Approx(20.0 * left));
}

// Nothing passes a closed partition; after its removal particles do.
TEST_CASE("Fixture physics: a partition that is removed lets particles pass") {
  Scene scene = parse_scene(R"(
box.size = [20.0, 10.0]
particles.count = 40
walls.left.kind = "static"
walls.right.kind = "static"
partition = [{ name = "door", axis = "x", position = 8.0 }]
measure = { burn_in = 0.0, duration = 200.0 }
)",
                            "");
  Simulation<2> simulation(model_of<2>(scene, 6), start_state<2>(scene, 6));
  Measurement<2> measurement(simulation, scene.measure, 200.0);
  simulation.run_until(50.5);
  scene.partitions[0].present = false;
  simulation.set_laws(model_of<2>(scene, 6));
  simulation.run_until(200.0);
  const Measured result = measurement.result();
  REQUIRE(result.compartments.has_value());
  const std::vector<double>& shares = result.compartments->share_left_series;
  REQUIRE(shares.size() > 150);
  for (std::size_t k = 1; k <= 50; ++k) CHECK(shares[k] == shares[0]);
  double changes = 0.0;
  for (std::size_t k = 52; k < shares.size(); ++k) changes += shares[k] != shares[k - 1];
  CHECK(changes > 50.0);
}

// Small disks pass the membrane and large ones do not. In the dilute limit the large ones alone
// press on it: F = N T / (l - d) on the length l of their side. Their second virial coefficient
// adds N pi d^2 / (2 A), here 1.1 %. The small ones have one chemical potential on both sides, and
// cancel to first order (McMillan & Mayer 1945).
TEST_CASE("Fixture physics: osmotic pressure of large disks at a membrane") {
  const std::string text = R"(
box.size = [40.0, 30.0]
walls.left.kind = "static"
walls.right.kind = "static"
[[species]]
name = "large"
count = 12
count_left = 12
diameter = 0.6
mass = 3.0
[[species]]
name = "small"
count = 40
diameter = 0.2
mass = 0.5
[[partition]]
axis = "x"
position = 20.0
passes = ["small"]
)";
  Sample forces;
  for (std::uint64_t seed = 1; seed <= 48; ++seed) {
    const Measured result = measured(text, 100.0, 1500.0, seed);
    REQUIRE(result.fixtures.size() == 1);
    CHECK(result.compartments->count_left.mean > 12.0);
    forces.add(result.fixtures[0].force.at(0).mean / result.species.at(0).temperature->mean);
  }
  const double ideal = 12.0 / (20.0 - 0.6);
  const double of_large = 12.0 * kPi * 0.6 * 0.6 / (2.0 * 600.0);
  const double expected = ideal * (1.0 + of_large);
  MESSAGE("F/T " << forces.mean() << "(" << forces.standard_error() << "), expected " << expected);
  CHECK(forces.standard_error() < 0.01 * expected);
  CHECK(std::fabs(forces.mean() - expected) < 3.0 * forces.standard_error());
}

}  // namespace clatter::fixture_physics
