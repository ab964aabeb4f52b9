#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "engine/physics/theory.h"
#include "tests/engine/observables/observed.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

// The samples of a run are counted again by a loop over all pairs. The boxes have many cells along
// some axes and few along others. 50,000 bins need distances in double precision.
TEST_CASE_TEMPLATE("Radial distribution: counts all pairs of all samples", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  constexpr double kEnd = 6.0, kInterval = 2.0;
  for (const auto& [bins, walls] : {std::pair(40, false), {40, true}, {50'000, false}}) {
    CAPTURE(bins);
    CAPTURE(walls);
    Scene scene = gas(D == 2 ? VecX(Vec2(23.0, 9.0)) : VecX(Vec<3>(12.0, 7.0, 5.0)), 60, 0.9);
    if (walls) wall_in(scene, 1, {.kind = WallKind::Thermal, .temperature = 1.0});
    Measure measure;
    measure.radial_distribution = {.interval = kInterval, .range = 3.0, .bins = bins};
    const ResultTable table =
        table_of(observed<D>(scene, measure, ObservableKind::RadialDistribution, kEnd, 3),
                 "radial_distribution");
    const TableColumn r = column_of(table, "r"), g = column_of(table, "g");
    const auto rows = static_cast<std::size_t>(bins);
    REQUIRE(r.values.size() == rows);
    // Half the shortest period is 2.5 in 3D.
    const double range = D == 2 ? 3.0 : 2.5, width = (range - 1.0) / bins;
    CHECK(r.values.back() == doctest::Approx(range - 0.5 * width));

    const auto simulation = simulation_of<D>(scene, 3);
    const Model<D>& model = simulation->model();
    std::vector<double> counts(rows, 0.0);
    for (int sample = 1; sample <= 3; ++sample) {
      simulation->run_until(sample * kInterval);
      const State<D> state = simulation->state();
      for (std::size_t i = 0; i < state.positions.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const double apart =
              nearest_image<D>(model, state.positions[i] - state.positions[j]).norm();
          const auto bin = static_cast<std::size_t>((apart - 1.0) / width);
          if (bin < counts.size()) counts[bin] += 1.0;
        }
      }
    }
    // Without walls the expected counts are those of a shell in the whole volume.
    for (std::size_t bin = 0; bin < counts.size() && !walls; ++bin) {
      CAPTURE(bin);
      const double low = 1.0 + width * static_cast<double>(bin), high = low + width;
      const double shell =
          D == 2 ? std::numbers::pi * (high * high - low * low)
                 : 4.0 / 3.0 * std::numbers::pi * (std::pow(high, 3) - std::pow(low, 3));
      CHECK(g.values[bin] ==
            doctest::Approx(counts[bin] / (3.0 * 60.0 * 59.0 / 2.0 * shell / scene.box.prod()))
                .epsilon(1e-9));
    }
    // With walls the ratio of both is the set covariance of the region, checked below.
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
      CHECK((g.values[bin] == 0.0) == (counts[bin] == 0.0));
    }
  }
}

// g(r) of a dilute gas between walls on all sides is near 1 at all distances, also at those of the
// size of the box. Without the set covariance it would fall to 0.4. Sample: 2000 frames of 20
// particles. The attraction of excluded volume between particles and walls is of the order of phi =
// 0.01.
TEST_CASE_TEMPLATE("Radial distribution: a dilute gas between walls has g = 1", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  Scene scene = gas(D == 2 ? VecX(Vec2(46.0, 31.0)) : VecX(Vec<3>(13.0, 9.0, 11.0)), 20, 1.0);
  for (int axis = 0; axis < D; ++axis) {
    wall_in(scene, axis, {.kind = WallKind::Thermal, .temperature = 1.0});
  }
  Measure measure;
  measure.radial_distribution = {.interval = 5.0, .range = 30.0, .bins = 10};
  const ResultTable table =
      table_of(observed<D>(scene, measure, ObservableKind::RadialDistribution, 10'000.0, 8),
               "radial_distribution");
  const TableColumn g = column_of(table, "g");
  for (std::size_t bin = 1; bin < 9; ++bin) {
    CAPTURE(bin);
    CHECK(g.standard_errors[bin] < 0.03);
    CHECK(g.values[bin] == doctest::Approx(1.0).epsilon(0.03 + 5.0 * g.standard_errors[bin]));
  }
}

// Henderson 1975, at phi = 0.3: chi = 1.7731, accurate to 0.3 %. Carnahan & Starling 1969 for
// spheres at 0.2: 1.7578. Relative standard error 0.15 %.
// A fit of billions of bins would not fit into the memory.
TEST_CASE("Radial distribution: very narrow bins have no value at contact") {
  Measure measure;
  measure.radial_distribution.bins = 100;
  const Scene scene = gas(2.0000001, 50.0, 20, 1.0);
  const Measured measured = observed<2>(scene, measure, ObservableKind::RadialDistribution, 3.0, 1);
  CHECK(column_of(table_of(measured, "radial_distribution"), "g").values.size() == 100);
  CHECK_THROWS(mean_of(measured, "radial_distribution.contact"));
}

TEST_CASE("Observables: samples at the rounding of the start of the averages are no error") {
  Measure measure;
  measure.burn_in = 1e5;
  measure.observables = {ObservableKind::MeanSquaredDisplacement,
                         ObservableKind::RadialDistribution};
  measure.mean_squared_displacement = {.interval = 1e-12, .longest = 1e-11, .lags = 4};
  measure.radial_distribution.interval = 1e-12;
  const auto simulation = simulation_of<2>(gas(9.0, 7.0, 2, 1.0), 1);
  Measurement<2> measurement(*simulation, measure, 1e5 + 1e-10);
  CHECK(simulation->run_until(1e5 + 1e-10));
  CHECK(measurement.result().tables().size() == 2);
}

TEST_CASE("Radial distribution: g at contact is the theory's, within 0.5 %" *
          doctest::test_suite("slow")) {
  Measure measure;
  measure.radial_distribution.interval = 0.5;
  const auto check = [](const Estimate& contact, double expected) {
    MESSAGE(contact.mean, " +- ", contact.standard_error, ", theory ", expected);
    CHECK(contact.standard_error < 0.002 * expected);
    CHECK(contact.mean == doctest::Approx(expected).epsilon(0.005));
  };
  const double side = std::sqrt(2000.0 * std::numbers::pi / (4.0 * 0.3));
  check(mean_of(observed<2>(gas(side, side, 2000, 1.0), measure, ObservableKind::RadialDistribution,
                            3000.0, 1),
                "radial_distribution.contact"),
        contact_correlation(0.3, 2));
  const double edge = std::cbrt(2000.0 * std::numbers::pi / (6.0 * 0.2));
  check(mean_of(observed<3>(gas(Vec<3>(edge, edge, edge), 2000, 1.0), measure,
                            ObservableKind::RadialDistribution, 1500.0, 1),
                "radial_distribution.contact"),
        contact_correlation(0.2, 3));
}
