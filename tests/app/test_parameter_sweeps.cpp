// The settings that `clatter bench accuracy` compares.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/bench/parameter_sweeps.h"

namespace clatter {

namespace {

constexpr double kCollisionTime = 0.25;

// A gas between two different driven walls, periodic along y.
Scene gas() {
  Scene scene;
  scene.particles.count = 50;
  scene.particles.restitution = 0.9;
  scene.box = Vec2(30.0, 20.0);
  scene.measure.cells = {7, 4};
  scene.walls[kLeft] = Wall{.kind = WallKind::Driven, .restitution = 0.8, .drive_speed = 2.0};
  scene.walls[kRight] = Wall{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 3.0};
  return scene;
}

std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const ParameterSweep& sweep : sweeps_of(scene, kCollisionTime)) names.push_back(sweep.name);
  return names;
}

ParameterSweep sweep_of(const Scene& scene, const std::string& name) {
  std::vector<ParameterSweep> sweeps = sweeps_of(scene, kCollisionTime);
  const auto found = std::ranges::find(sweeps, name, &ParameterSweep::name);
  REQUIRE_MESSAGE(found != sweeps.end(), name);
  return *found;
}

// Checks the values of a sweep, and that names show them. A sweep may begin with a setting without
// a value.
void check_values(const ParameterSweep& sweep, const std::string& first,
                  const std::vector<double>& values) {
  CAPTURE(sweep.name);
  const std::size_t skipped = first.empty() ? 0 : 1;
  REQUIRE(sweep.settings.size() == values.size() + skipped);
  if (skipped > 0) {
    CHECK(sweep.settings[0].name == first);
    CHECK(std::isnan(sweep.settings[0].value));
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Setting& setting = sweep.settings[k + skipped];
    CHECK(setting.value == values[k]);
    CHECK(std::stod(setting.name) == doctest::Approx(values[k]).epsilon(5e-3));
  }
}

}  // namespace

TEST_CASE("Parameter sweeps: a gas has each in turn, with its title") {
  std::vector<std::pair<std::string, std::string>> titles;
  for (const ParameterSweep& sweep : sweeps_of(gas(), kCollisionTime)) {
    titles.emplace_back(sweep.name, sweep.title);
    CHECK(sweep.has_limit == (sweep.name == "stroke"));
  }
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"contact_time", "t_c / time between collisions"},
      {"estimator", "fields: time between snapshots"},
      {"cells", "fields: width of cells"},
      {"kernel", "fields: width of the Gaussian"},
      {"stroke", "stroke of the shaking walls"},
      {"count", "number of disks at equal line density"},
      {"time_step", "time-stepped engine: dt"}};
  CHECK(titles == expected);
}

TEST_CASE("Parameter sweeps: a parameter without meaning in the scene is absent") {
  const auto lacks = [](const Scene& scene, const std::string& name) {
    return std::ranges::count(names_of(scene), name) == 0;
  };
  Scene elasticised = gas();
  elasticised.contact_time = 1e-3;
  CHECK(lacks(elasticised, "contact_time"));
  Scene sampled = gas();
  sampled.measure.estimator = Estimator::Snapshot;
  CHECK(lacks(sampled, "estimator"));
  Scene undriven = gas();
  undriven.walls[kLeft] = undriven.walls[kRight] = Wall{};
  CHECK(lacks(undriven, "stroke"));
  Scene half_driven = gas();
  half_driven.walls[kRight] = Wall{};
  CHECK_FALSE(lacks(half_driven, "stroke"));
  Scene closed = gas();
  closed.walls[kBottom] = closed.walls[kTop] = Wall{};
  CHECK(lacks(closed, "count"));
  Scene few = gas();
  few.particles.count = 31;
  CHECK(lacks(few, "count"));
  few.particles.count = 32;
  CHECK_FALSE(lacks(few, "count"));
  Scene low = gas();
  low.box[1] = 15.9;
  CHECK(lacks(low, "count"));
  low.box[1] = 16.0;
  CHECK_FALSE(lacks(low, "count"));
  Scene falling = gas();
  falling.gravity = Vec2(0.0, -1.0);
  CHECK(lacks(falling, "time_step"));
}

TEST_CASE("Parameter sweeps: contact times are shares of the time between collisions") {
  const ParameterSweep sweep = sweep_of(gas(), "contact_time");
  check_values(sweep, "off", {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1});
  CHECK_FALSE(sweep.settings[0].scene.contact_time);
  for (std::size_t k = 1; k < sweep.settings.size(); ++k) {
    CHECK(sweep.settings[k].scene.contact_time == sweep.settings[k].value * kCollisionTime);
  }
}

TEST_CASE("Parameter sweeps: estimators, cells and kernels change the measurement") {
  const ParameterSweep intervals = sweep_of(gas(), "estimator");
  check_values(intervals, "exact", {0.1, 0.3, 1.0, 3.0, 10.0});
  CHECK(intervals.settings[0].scene.measure.estimator == Estimator::Exact);
  for (std::size_t k = 1; k < intervals.settings.size(); ++k) {
    CHECK(intervals.settings[k].scene.measure.estimator == Estimator::Snapshot);
    CHECK(intervals.settings[k].scene.measure.interval == intervals.settings[k].value);
  }

  const ParameterSweep widths = sweep_of(gas(), "cells");
  check_values(widths, "", {0.5, 1.0, 1.5, 3.0, 6.0});
  for (const Setting& setting : widths.settings) {
    CHECK(setting.scene.measure.cells[0] * setting.value == 30.0);
    CHECK(setting.scene.measure.cells[1] == 4);
  }

  const ParameterSweep kernels = sweep_of(gas(), "kernel");
  check_values(kernels, "", {0.25, 0.5, 1.0, 2.0});
  for (const Setting& setting : kernels.settings) {
    CHECK(setting.scene.measure.estimator == Estimator::Snapshot);
    CHECK(setting.scene.measure.interval == 3.0);
    CHECK(setting.scene.measure.kernel == Kernel::Gaussian);
    CHECK(setting.scene.measure.width == setting.value);
  }
}

TEST_CASE("Parameter sweeps: shaking walls have the drive speed of their driven wall as a limit") {
  const ParameterSweep sweep = sweep_of(gas(), "stroke");
  check_values(sweep, "limit", {0.02, 0.05, 0.1, 0.2});
  CHECK(sweep.settings[0].scene.walls[kLeft]->kind == WallKind::Driven);
  for (std::size_t k = 1; k < sweep.settings.size(); ++k) {
    const Setting& setting = sweep.settings[k];
    const Wall& left = *setting.scene.walls[kLeft];
    const Wall& right = *setting.scene.walls[kRight];
    CHECK(left.kind == WallKind::Sawtooth);
    CHECK(right.kind == WallKind::Sawtooth);
    CHECK(left.stroke == setting.value);
    CHECK(right.stroke == setting.value);
    CHECK(1.8 * left.stroke * left.frequency == doctest::Approx(2.0).epsilon(1e-12));
    CHECK(1.9 * right.stroke * right.frequency == doctest::Approx(3.0).epsilon(1e-12));
  }
}

TEST_CASE("Parameter sweeps: numbers of disks keep the number per length of the walls") {
  const ParameterSweep sweep = sweep_of(gas(), "count");
  check_values(sweep, "", {200.0, 100.0, 50.0, 25.0, 13.0});
  for (const Setting& setting : sweep.settings) {
    CHECK(setting.scene.particles.count == setting.value);
    CHECK(setting.scene.box[0] == 30.0);
    CHECK(setting.scene.box[1] == doctest::Approx(0.4 * setting.value).epsilon(1e-12));
  }
}

TEST_CASE("Parameter sweeps: fine time steps have shorter runs") {
  const ParameterSweep sweep = sweep_of(gas(), "time_step");
  check_values(sweep, "exact", {1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1});
  CHECK(sweep.settings[0].time_step == 0.0);
  CHECK(sweep.settings[0].duration == 1.0);
  const double shares[] = {0.1, 0.3, 1.0, 1.0, 1.0, 1.0};
  for (std::size_t k = 1; k < sweep.settings.size(); ++k) {
    CHECK(sweep.settings[k].time_step == sweep.settings[k].value);
    CHECK(sweep.settings[k].duration == doctest::Approx(shares[k - 1]).epsilon(1e-12));
  }
}

}  // namespace clatter
