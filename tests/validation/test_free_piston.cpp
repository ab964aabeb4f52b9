// Gases beside a free piston against exact results.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/measure/measurement.h"
#include "engine/scene/scene_file.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

namespace clatter::free_piston_physics {

using namespace testing;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Samples of the piston over independent runs.
struct PistonSamples {
  Sample place, variance, temperature, force;
};

PistonSamples samples(const std::string& text, double burn_in, double duration,
                      std::uint64_t runs) {
  PistonSamples all;
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const Measured result = run(parse_scene(text, ""), burn_in, duration, seed);
    REQUIRE(result.piston.has_value());
    all.place.add(result.piston->position.mean);
    all.variance.add(result.piston->variance.mean);
    all.temperature.add(result.piston->temperature.mean);
    all.force.add(result.piston->force_left.mean);
  }
  return all;
}

/// Checks the variance of the place: within the runs, and between their means.
void check_variance(const PistonSamples& all, double expected, double precision, double runs) {
  const double error = all.place.standard_error();
  const double variance = all.variance.mean() + (runs - 1.0) * error * error;
  MESSAGE(variance << "(" << all.variance.standard_error() << "), expected " << expected);
  CHECK(all.variance.standard_error() < precision * expected);
  CHECK(std::fabs(variance - expected) < 4.0 * all.variance.standard_error());
}

/// Checks a mean within 4 standard errors, which must be below a share of the expected value.
void check_sample(const Sample& sample, double expected, double precision) {
  MESSAGE(sample.mean() << "(" << sample.standard_error() << "), expected " << expected);
  CHECK(sample.standard_error() < precision * std::fabs(expected));
  CHECK(std::fabs(sample.mean() - expected) < 4.0 * sample.standard_error());
}

const std::string kEnds = "walls.left.kind = \"static\"\nwalls.right.kind = \"static\"\n";

/// Pressure of disks of diameter 1 and T = 1 by scaled particle theory.
double pressure(double density) {
  const double free = 1.0 - density * kPi / 4.0;
  return density / (free * free);
}

/// The density in the bulk of a gas of `count` disks between two hard walls at a distance, which
/// are periodic at the width. The adsorption at a wall is -d gamma / d mu of scaled particle
/// theory.
double bulk_density(double count, double distance, double width) {
  const auto tension = [](double n) {
    const double phi = n * kPi / 4.0;
    return -n * phi / (2.0 * (1.0 - phi) * (1.0 - phi));
  };
  const auto content = [&](double n) {
    const double h = 1e-5 * n;
    const double potential = (pressure(n + h) - pressure(n - h)) / n;
    const double adsorption = -(tension(n + h) - tension(n - h)) / potential;
    return width * (n * (distance - 1.0) + 2.0 * adsorption);
  };
  double low = 0.0, high = 1.0;
  for (int step = 0; step < 100; ++step) {
    const double middle = 0.5 * (low + high);
    (content(middle) < count ? low : high) = middle;
  }
  return low;
}

}  // namespace

// The place X has a density proportional to (X - d)(L - X - d).
TEST_CASE("Free piston physics: one disk on each side") {
  const PistonSamples all =
      samples("box.size = [12.0, 5.0]\nparticles = { count = 2, count_left = 1 }\n" + kEnds +
                  "piston = { position = 6.0, mass = 2.0 }\n",
              100.0, 2000.0, 60);
  check_sample(all.place, 6.0, 0.01);
  check_variance(all, 10.0 * 10.0 / 20.0, 0.03, 60.0);
}

// With a weight F over N disks, X - d has the density (X - d)^N exp(-F X / T).
TEST_CASE("Free piston physics: a weighed piston over one disk on a thermal wall") {
  const std::string lid =
      "box.size = [5.0, 80.0]\nparticles = { count = 1, count_left = 1 }\nwalls.top.kind = "
      "\"static\"\n"
      "walls.bottom = { kind = \"thermal\", temperature = 1.5 }\n"
      "piston = { axis = \"y\", position = 4.0, mass = 3.0, force = -1.0 }\n";
  const PistonSamples all = samples(lid, 100.0, 2000.0, 60);
  check_sample(all.place, 1.0 + 2.0 * 1.5, 0.01);
  check_variance(all, 2.0 * 1.5 * 1.5, 0.05, 60.0);
  check_sample(all.temperature, 1.5, 0.02);
  check_sample(all.force, 1.0, 1e-3);
}

// Both sides have the pressure and density of scaled particle theory, which is good to some percent
// here.
TEST_CASE("Free piston physics: 40 disks beside 20") {
  constexpr int kRuns = 24;
  const double length = 20.0, width = 10.0;
  const auto gap = [&](double place) {
    return pressure(bulk_density(20.0, length - place, width)) -
           pressure(bulk_density(40.0, place, width));
  };
  double low = 10.0, high = 17.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (gap(middle) < 0.0 ? low : high) = middle;
  }
  const double h = 1e-3;
  const double variance = 2.0 * h / (width * (gap(low + h) - gap(low - h)));
  const PistonSamples all =
      samples("box.size = [20.0, 10.0]\nparticles = { count = 60, count_left = 40 }\n" + kEnds +
                  "piston = { position = 13.0, mass = 20.0 }\n",
              200.0, 3000.0, kRuns);
  check_sample(all.place, low, 0.003);
  check_sample(all.temperature, 1.0, 0.02);
  // Scaled particle theory has a variance of 0.459 and no mean of the pressure over the places. An
  // independent simulator gives both, with these standard errors.
  const double error = all.place.standard_error();
  const double within = all.variance.mean() + (kRuns - 1.0) * error * error;
  MESSAGE("variance " << within << ", theory " << variance << "; force " << all.force.mean());
  CHECK(std::fabs(within - 0.436) < 4.0 * std::hypot(0.011, all.variance.standard_error()));
  CHECK(std::fabs(all.force.mean() - 5.76) < 4.0 * std::hypot(0.02, all.force.standard_error()));
  CHECK(std::fabs(variance / 0.436 - 1.0) < 0.06);
}

// Everything that has energy is in the sum: gas, piston, gravity and weight. Hits on the piston and
// collisions take from it what the results say.
TEST_CASE("Free piston physics: energy with losses, gravity and a weight closes") {
  for (const char* mass : {"1e-6", "3.0", "1e6"}) {
    CAPTURE(mass);
    const std::string text =
        "box.size = [14.0, 9.0]\nparticles = { count = 30, restitution = 0.9 }\n" + kEnds +
        "walls.bottom.kind = \"static\"\nwalls.top.kind = \"static\"\n"
        "gravity.acceleration = [0.2, -0.3]\ncollapse.contact_time = 1e-4\n"
        "piston = { position = 7.0, mass = " +
        mass + ", force = -0.4, restitution = 0.8, thickness = 0.3 }\n";
    const Scene scene = parse_scene(text, "");
    Simulation<2> gas(model_of<2>(scene, 3), start_state<2>(scene, 3));
    const auto energy = [&] {
      double sum = gas.kinetic_energy();
      const State<2> state = gas.state();
      for (const Vec2& r : state.positions) sum -= gas.model().gravity.dot(r);
      const double velocity = state.piston->velocity;
      return sum + 0.5 * gas.model().free_piston->mass * velocity * velocity +
             0.4 * state.piston->place;
    };
    const double start = energy();
    Totals<2> totals(gas);
    PistonTotals<2> piston(gas);
    const Observation<2> first(gas, totals), second(gas, piston);
    gas.run_until(20.0, 60'000);
    const WindowTotals<2> of_gas = totals.close_window();
    const PistonWindow of_piston = piston.close_window();
    CHECK(of_piston.hits[0] + of_piston.hits[1] > 20.0);
    CHECK(of_piston.dissipated > 0.0);
    CHECK(start - energy() ==
          doctest::Approx(of_gas.dissipated + of_piston.dissipated).epsilon(1e-9));
    CHECK(gas.deepest_overlap() < 1e-11);
  }
}

}  // namespace clatter::free_piston_physics
