#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "tests/support/statistics.h"
#include "tests/validation/experiment.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

const std::vector<Field> kFields = {Quantity::Density,
                                    Field(Quantity::Velocity, 0),
                                    Field(Quantity::Velocity, 1),
                                    Field(Quantity::Temperature, 0),
                                    Field(Quantity::Temperature, 1),
                                    Field(Quantity::Stress, 0, 0),
                                    Field(Quantity::Stress, 1, 1),
                                    Field(Quantity::Stress, 0, 1),
                                    Field(Quantity::HeatFlux, 0),
                                    Field(Quantity::HeatFlux, 1),
                                    Quantity::Dissipation};

/// Probability of the deviations of columns from an expected value, in units of their standard
/// errors.
double flatness_p(const std::vector<Estimate>& columns, double expected) {
  double sum = 0.0;
  for (const Estimate& e : columns) {
    const double off = (e.mean - expected) / e.standard_error;
    sum += off * off;
  }
  return chi_squared_p(sum, static_cast<double>(columns.size()));
}

/// Probability of the differences of two profiles with independent errors.
double agreement_p(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
  double sum = 0.0, freedom = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double error = std::hypot(a[i].standard_error, b[i].standard_error);
    if (!std::isfinite(a[i].mean) || !std::isfinite(b[i].mean) || error == 0.0) continue;
    sum += std::pow((a[i].mean - b[i].mean) / error, 2);
    freedom += 1.0;
  }
  return chi_squared_p(sum, freedom);
}

}  // namespace

TEST_CASE("Fields: momentum and energy of the vibrated gas balance from wall to wall") {
  // Cells of a quarter diameter: the outermost two columns never contain a centre.
  Scene scene = vibrated_gas(0.9, 1.0);
  scene.measure.fields = kFields;
  scene.measure.cells = {80, 1};
  const Measured result = run(scene, 300.0, 20000.0, 115);
  const Profile& profile = *result.profile;
  const double width = 0.25, height = 25.0;

  // Momentum does not accumulate. Columns differ by the change of their momentum over the duration
  // of the run, far below the errors of the mean pressure.
  const double pressure = 0.5 * (result.pressure[kLeft]->mean + result.pressure[kRight]->mean);
  const std::vector<Estimate>& stress = profile.at(Field(Quantity::Stress, 0, 0));
  double largest = 0.0;
  for (const Estimate& e : stress) largest = std::max(largest, std::fabs(e.mean / pressure + 1.0));
  const double p = flatness_p(stress, -pressure);
  MESSAGE("sigma_xx over wall pressure is -1 within ", largest, ", p = ", p);
  CHECK(largest < 1e-3);
  CHECK(p > kMinProbability);
  CHECK(std::fabs(stress.front().mean + result.pressure[kLeft]->mean) < 1e-9 * pressure);

  double dissipation = 0.0;
  for (const Estimate& e : profile.at(Quantity::Dissipation)) {
    CHECK(e.mean <= 0.0);
    dissipation += e.mean * width * height;
  }
  const double balance = std::fabs(dissipation / result.walls_in->mean + 1.0);
  MESSAGE("integral of zeta over wall power is -1 within ", balance);
  CHECK(balance < 1e-3);
  CHECK(dissipation == doctest::Approx(-result.dissipated.mean).epsilon(1e-9));

  // Heat flows into the gas at both ends.
  const std::vector<Estimate>& q = profile.at(Field(Quantity::HeatFlux, 0));
  const double in = (q.front().mean - q.back().mean) * height;
  MESSAGE("heat flux at the walls over their power is 1 within ", in / result.walls_in->mean - 1.0);
  CHECK(in == doctest::Approx(result.walls_in->mean).epsilon(1e-9));
  CHECK(std::fabs(q.front().mean + q.back().mean) <
        5.0 * std::hypot(q.front().standard_error, q.back().standard_error));
  // dq_x/dx = zeta between the centres of neighbouring columns, without the wall columns. V = 0
  // there, except for the change of density over the run.
  for (std::size_t i = 10; i + 11 < q.size(); i += 10) {
    double lost = 0.5 * (profile.at(Quantity::Dissipation)[i].mean +
                         profile.at(Quantity::Dissipation)[i + 10].mean);
    for (std::size_t k = i + 1; k < i + 10; ++k) lost += profile.at(Quantity::Dissipation)[k].mean;
    CHECK(std::fabs(q[i + 10].mean - q[i].mean - lost * width) < 2e-3 * q.front().mean);
  }
}

TEST_CASE("Fields: an elastic gas at rest conducts and dissipates nothing") {
  Scene scene = gas_of_fraction(0.1, 200, 1.0);
  scene.measure.fields = kFields;
  scene.measure.cells = {10, 4};
  const Measured result = run(scene, 50.0, 10000.0, 116);
  const Profile& profile = *result.profile;
  for (const Estimate& e : profile.at(Quantity::Dissipation)) {
    CHECK(e.mean == 0.0);
  }
  const double q_x = flatness_p(profile.at(Field(Quantity::HeatFlux, 0)), 0.0);
  const double q_y = flatness_p(profile.at(Field(Quantity::HeatFlux, 1)), 0.0);
  const double s_xy = flatness_p(profile.at(Field(Quantity::Stress, 0, 1)), 0.0);
  const double equal = agreement_p(profile.at(Field(Quantity::Temperature, 0)),
                                   profile.at(Field(Quantity::Temperature, 1)));
  MESSAGE("p of q_x = 0: ", q_x, ", q_y = 0: ", q_y, ", sigma_xy = 0: ", s_xy,
          ", T_x = T_y: ", equal);
  CHECK(std::min({q_x, q_y, s_xy, equal}) > kMinProbability);

  // p = rho T (1 + 2 phi chi), with T = 1 of all particles. The fixed momentum makes collisions
  // rarer and softer: the pressure contribution of collisions decreases by some 1/N, 0.1 %.
  const double phi = 0.1;
  const double density = 4.0 * phi / std::numbers::pi;
  const double expected = density * (1.0 + 2.0 * phi * contact_correlation(phi));
  for (const Field field : {Field(Quantity::Stress, 0, 0), Field(Quantity::Stress, 1, 1)}) {
    double mean = 0.0;
    for (const Estimate& e : profile.at(field)) {
      CHECK(std::fabs(e.mean + expected) < 5.0 * e.standard_error);
      CHECK(e.standard_error < 0.01 * expected);
      mean += e.mean / 10.0;
    }
    // Columns share particles. Their mean is far more precise than each column.
    CHECK(std::fabs(mean / expected + 1.0) < 0.003);
  }
}

TEST_CASE("Fields: temperature and stress are those about the mean velocity") {
  // Two halves of a gas with opposite flows mix. T is measured relative to V, so that the flow does
  // not contribute to the stress.
  Scene scene = gas_of_fraction(0.1, 200, 1.0);
  scene.measure.fields = kFields;
  scene.measure.cells = {1, 1};
  const std::uint64_t seed = 117;
  State<2> start = start_state<2>(scene, seed);
  for (Vec2& v : start.velocities) v += Vec2(3.0, -2.0);
  scene.measure.duration = 1000.0;
  scene.measure.burn_in = 0.0;
  Simulation<2> simulation(model_of<2>(scene, seed), start);
  Measurement measurement(simulation, scene.measure, 1000.0);
  simulation.run_until(1000.0);
  const Measured flowing = measurement.result();
  const Measured still = run(scene, 0.0, 1000.0, seed);
  for (const Field field : {Field(Quantity::Temperature, 0), Field(Quantity::Stress, 0, 0),
                            Field(Quantity::Stress, 1, 1)}) {
    const Estimate &a = flowing.profile->at(field)[0], &b = still.profile->at(field)[0];
    CHECK(std::fabs(a.mean - b.mean) < 5.0 * std::hypot(a.standard_error, b.standard_error));
    CHECK(a.standard_error < 0.02 * std::fabs(a.mean));
  }
  CHECK(flowing.profile->at(Field(Quantity::Velocity, 0))[0].mean ==
        doctest::Approx(3.0).epsilon(1e-9));
  CHECK(flowing.profile->at(Field(Quantity::Velocity, 1))[0].mean ==
        doctest::Approx(-2.0).epsilon(1e-9));
  const Estimate& q = flowing.profile->at(Field(Quantity::HeatFlux, 0))[0];
  CHECK(std::fabs(q.mean) < 5.0 * q.standard_error);
  CHECK(q.standard_error < 0.01);
}

TEST_CASE("Fields: snapshots agree with the exact estimator") {
  Scene scene = vibrated_gas(0.9, 1.0);
  scene.measure.fields = kFields;
  scene.measure.cells = {20, 1};
  const Measured exact = run(scene, 300.0, 5000.0, 118);
  scene.measure.estimator = Estimator::Snapshot;
  scene.measure.interval = 1.7;
  const Measured snapshot = run(scene, 300.0, 5000.0, 119);
  double least = 1.0;
  for (const Field field : kFields) {
    const double p = agreement_p(exact.profile->at(field), snapshot.profile->at(field));
    CAPTURE(name_of(field));
    CHECK(p > kMinProbability);
    least = std::min(least, p);
  }
  MESSAGE("least p of ", kFields.size(), " fields: ", least);
}

TEST_CASE("Fields: the stress along y carries the weight above it") {
  Scene scene = gas(15.0, 12.0, 60, 1.0);
  wall_in(scene, 1, {.kind = WallKind::Thermal, .temperature = 1.0});
  scene.gravity = Vec2(0.0, -0.3);
  scene.measure.fields = kFields;
  scene.measure.cells = {3, 12};
  scene.measure.profile_axis = Axis::Y;
  const Measured result = run(scene, 100.0, 5000.0, 120);
  const Profile& profile = *result.profile;
  REQUIRE(profile.edges.size() == 13);
  CHECK(profile.edges.back() == doctest::Approx(12.0));
  // Isothermal. The stress carries the weight above: -sigma_yy(y) = p_top + g sum of rho above,
  // within 1e-3, the change of momentum over the run.
  const double p_top = result.pressure[kTop]->mean, p_bottom = result.pressure[kBottom]->mean;
  CHECK(p_bottom - p_top == doctest::Approx(0.3 * 60.0 / 15.0).epsilon(1e-3));
  double above = p_top;
  for (std::size_t i = 12; i-- > 0;) {
    CAPTURE(i);
    const double weight = 0.3 * profile.at(Quantity::Density)[i].mean;
    const double stress = profile.at(Field(Quantity::Stress, 1, 1))[i].mean;
    // The mean over a cell, in which the weight is nearly uniform.
    CHECK(std::fabs(stress + above + 0.5 * weight) < 0.02 * p_bottom);
    above += weight;
    for (const Field field : {Field(Quantity::Temperature, 0), Field(Quantity::Temperature, 1)}) {
      const Estimate& e = profile.at(field)[i];
      CHECK(std::fabs(e.mean - 1.0) < 5.0 * e.standard_error);
    }
  }
}
