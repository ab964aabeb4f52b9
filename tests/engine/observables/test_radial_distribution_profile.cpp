#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>
#include <random>

#include "engine/observables/radial_distribution_profile.h"
#include "engine/physics/theory.h"
#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// An ideal gas: points whose number per slab is fixed by chance, with a density that differs from
// slab to slab. [parts] sums of the observable.
template <int D>
ObservableResult ideal_gas(const Scene& scene, const RadialProfileSettings& settings,
                           const std::vector<double>& densities, int parts, int samples) {
  Model<D> model = model_of<D>(scene, 1);
  model.diameter = 1e-4;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::discrete_distribution<int> slab(densities.begin(), densities.end());
  std::vector<ObservableSums> sums;
  std::unique_ptr<RadialDistributionProfile<D>> last;
  std::unique_ptr<Simulation<D>> simulation;
  for (int part = 0; part < parts; ++part) {
    ObservableSums of_part;
    for (int sample = 0; sample < samples; ++sample) {
      State<D> state;
      for (int k = 0; k < scene.particles.count; ++k) {
        Vec<D> position;
        for (int axis = 0; axis < D; ++axis) {
          double place = share(random);
          if (axis == static_cast<int>(settings.axis)) {
            place = (slab(random) + place) / settings.slabs;
          }
          position[axis] = 1e-4 + place * (scene.box[axis] - 2e-4);
        }
        state.positions.push_back(position);
        state.velocities.push_back(Vec<D>::Zero());
      }
      last.reset();
      simulation = std::make_unique<Simulation<D>>(model, state);
      last = std::make_unique<RadialDistributionProfile<D>>(*simulation, settings);
      last->start();
      last->sample();
      ObservableSums window = last->close_window();
      of_part.values.resize(window.values.size(), 0.0);
      of_part += window;
    }
    sums.push_back(of_part);
  }
  return last->result({sums, sums});
}

}  // namespace

// Distances reach the size of the box, so that most pairs feel the walls. Sample: 64 x 4 states of
// 150 points. Each g is within 5 standard errors of 1, and the mean over a slab within 2 %.
TEST_CASE_TEMPLATE("Radial distribution profile: an ideal gas has g = 1 in each slab", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  for (const int axis : {0, D - 1}) {
    for (const int walls : {0, 1, 2}) {
      CAPTURE(axis);
      CAPTURE(walls);
      Scene scene = gas(D == 2 ? VecX(Vec2(9.0, 7.0)) : VecX(Vec<3>(6.0, 7.0, 5.0)), 150, 1.0);
      if (walls > 0) wall_in(scene, axis, {.kind = WallKind::Static});
      if (walls > 1) wall_in(scene, 1 - axis / (D - 1), {.kind = WallKind::Static});
      const RadialProfileSettings settings = {
          .interval = 1.0, .range = 30.0, .bins = 8, .axis = static_cast<Axis>(axis), .slabs = 5};
      const ObservableResult result =
          ideal_gas<D>(scene, settings, {4.0, 1.0, 2.0, 1.0, 3.0}, 64, 4);
      const TableColumn g = column_of(result.tables[0], "g");
      REQUIRE(g.values.size() == 40);
      for (std::size_t slab = 0; slab < 5; ++slab) {
        double sum = 0.0;
        for (std::size_t bin = 0; bin < 8; ++bin) {
          CAPTURE(slab);
          CAPTURE(bin);
          const double value = g.values[8 * slab + bin], error = g.standard_errors[8 * slab + bin];
          CHECK(std::fabs(value - 1.0) < 5.0 * error);
          if (bin > 1) sum += value / 6.0;
          if (bin > 1) CHECK(error < 0.04);
        }
        CHECK(sum == doctest::Approx(1.0).epsilon(0.02));
      }
    }
  }
}

// A slab that is the whole box: counted and normalised in another way.
TEST_CASE_TEMPLATE("Radial distribution profile: one slab has the g(r) of the box", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  for (const int walled : {0, 1, D}) {
    CAPTURE(walled);
    Scene scene = gas(D == 2 ? VecX(Vec2(13.0, 9.0)) : VecX(Vec<3>(8.0, 7.0, 5.0)), 50, 0.9);
    for (int axis = 0; axis < walled; ++axis) {
      wall_in(scene, axis, {.kind = WallKind::Thermal, .temperature = 1.0});
    }
    Measure measure;
    measure.radial_distribution = {.interval = 2.0, .range = 3.5, .bins = 25};
    measure.radial_distribution_profile = {
        .interval = 2.0, .range = 3.5, .bins = 25, .axis = Axis::X, .slabs = 1};
    const TableColumn whole =
        column_of(table_of(observed<D>(scene, measure, ObservableKind::RadialDistribution, 40.0, 3),
                           "radial_distribution"),
                  "g");
    const ResultTable table =
        table_of(observed<D>(scene, measure, ObservableKind::RadialDistributionProfile, 40.0, 3),
                 "radial_distribution_profile");
    const TableColumn g = column_of(table, "g");
    REQUIRE(g.values.size() == whole.values.size());
    for (std::size_t bin = 0; bin < g.values.size(); ++bin) {
      CHECK(g.values[bin] == doctest::Approx(whole.values[bin]).epsilon(1e-5));
      CHECK(g.standard_errors[bin] == doctest::Approx(whole.standard_errors[bin]).epsilon(1e-4));
    }
    CHECK(column_of(table, "x_low").values[0] == (walled > 0 ? 0.5 : 0.0));
    CHECK(column_of(table, "x_high").values[0] == scene.box[0] - (walled > 0 ? 0.5 : 0.0));
  }
}

// Between walls, at the density that a probe finds in the middle. Henderson's chi is accurate to
// 0.3 %. Sample: 8000 states of 140 disks in the middle.
TEST_CASE("Radial distribution profile: g at contact in the middle is Enskog's, within 1 %") {
  Scene scene = gas(31.0, 40.0, 400, 1.0);
  wall_in(scene, 0, {.kind = WallKind::Static});
  VecX lower = Vec2(10.5, 0.0), upper = Vec2(20.5, 40.0);
  Measure measure;
  measure.burn_in = 20.0;
  measure.observables = {ObservableKind::RadialDistributionProfile, ObservableKind::Probe};
  measure.probe.region = {lower, upper};
  // The middle one of three slabs has the region of the probe.
  measure.radial_distribution_profile = {
      .interval = 0.5, .range = 2.0, .bins = 50, .axis = Axis::X, .slabs = 3};
  const auto simulation = simulation_of<2>(scene, 1);
  Measurement<2> measurement(*simulation, measure, 4020.0);
  simulation->run_until(4020.0);
  const Measured measured = measurement.result();
  const ResultTable table = table_of(measured, "radial_distribution_profile");
  // A parabola through the bins within 0.2 of contact.
  Eigen::MatrixX3d powers(10, 3);
  Eigen::VectorXd values(10);
  for (int bin = 0; bin < 10; ++bin) {
    const auto row = static_cast<std::size_t>(50 + bin);
    const double x = column_of(table, "r").values[row] - 1.0;
    powers.row(bin) << 1.0, x, x * x;
    values[bin] = column_of(table, "g").values[row];
  }
  const double contact = powers.colPivHouseholderQr().solve(values)[0];
  const double fraction = mean_of(measured, "probe.density").mean * std::numbers::pi / 4.0;
  MESSAGE("g = ", contact, ", theory ", contact_correlation(fraction, 2), " at phi = ", fraction);
  CHECK(contact == doctest::Approx(contact_correlation(fraction, 2)).epsilon(0.01));
}
