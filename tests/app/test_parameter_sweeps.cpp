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

}  // namespace

TEST_CASE("Parameter sweeps: each setting changes its part of the scene by its value") {
  const std::vector<ParameterSweep> sweeps = sweeps_of(gas(), kCollisionTime);
  const auto check_each = [&](const char* name, const auto& check) {
    const auto sweep = std::ranges::find(sweeps, name, &ParameterSweep::name);
    REQUIRE(sweep != sweeps.end());
    CHECK(sweep->settings.size() > 3);
    for (const Setting& setting : sweep->settings) {
      CAPTURE(name);
      CAPTURE(setting.name);
      // The exact limit has no value.
      if (std::isnan(setting.value)) continue;
      CHECK(std::stod(setting.name) == doctest::Approx(setting.value).epsilon(5e-3));
      check(setting, setting.scene, setting.scene.measure);
    }
  };
  check_each("contact_time", [](const Setting& setting, const Scene& scene, const Measure&) {
    CHECK(scene.contact_time == setting.value * kCollisionTime);
  });
  check_each("estimator", [](const Setting& setting, const Scene&, const Measure& measure) {
    CHECK(measure.estimator == Estimator::Snapshot);
    CHECK(measure.interval == setting.value);
  });
  check_each("cells", [](const Setting& setting, const Scene&, const Measure& measure) {
    CHECK(measure.cells[0] * setting.value == 30.0);
    CHECK(measure.cells[1] == 4);
  });
  check_each("kernel", [](const Setting& setting, const Scene&, const Measure& measure) {
    CHECK(measure.kernel == Kernel::Gaussian);
    CHECK(measure.width == setting.value);
  });
  // Shaking walls have the drive speed of their driven wall as a limit.
  check_each("stroke", [](const Setting& setting, const Scene& scene, const Measure&) {
    const Wall &left = *scene.walls[kLeft], &right = *scene.walls[kRight];
    CHECK(left.kind == WallKind::Sawtooth);
    CHECK(left.stroke == setting.value);
    CHECK(right.stroke == setting.value);
    CHECK(1.8 * left.stroke * left.frequency == doctest::Approx(2.0).epsilon(1e-12));
    CHECK(1.9 * right.stroke * right.frequency == doctest::Approx(3.0).epsilon(1e-12));
  });
  check_each("count", [](const Setting& setting, const Scene& scene, const Measure&) {
    CHECK(scene.particles.count == setting.value);
    CHECK(scene.box[0] == 30.0);
    CHECK(scene.box[1] == doctest::Approx(0.4 * setting.value).epsilon(1e-12));
  });
  // Fine steps have shorter runs.
  check_each("time_step", [](const Setting& setting, const Scene&, const Measure&) {
    CHECK(setting.time_step == setting.value);
    CHECK(setting.duration == doctest::Approx(std::min(1.0, 100.0 * setting.value)).epsilon(1e-12));
  });
}

}  // namespace clatter
