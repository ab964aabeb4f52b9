#include <doctest/doctest.h>

#include "engine/dynamics/simulation.h"
#include "engine/initial/adapt_to_scene.h"
#include "engine/initial/start_state.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

Scene box(int count, double width, double height) {
  return load_scene("vibrated", {{"particles.count", std::to_string(count)},
                                 {"box.size", '[' + std::to_string(width) + ", " +
                                                  std::to_string(height) + ']'}});
}

std::size_t kept(const State<2>& before, const State<2>& now) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < now.positions.size(); ++i) {
    for (std::size_t j = 0; j < before.positions.size(); ++j) {
      const bool same = (now.positions[i] - before.positions[j]).norm() < 1e-12 &&
                        now.velocities[i] == before.velocities[j];
      count += same;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("Adapted state: particles that fit stay, others are added, none overlap") {
  const State<2> before = start_state<2>(box(200, 20.0, 25.0), 3);
  struct Case {
    Scene scene;
    std::size_t least;
  };
  for (const auto& [scene, least] :
       {Case{box(200, 20.0, 25.0), 200}, Case{box(300, 20.0, 25.0), 200},
        Case{box(120, 20.0, 25.0), 120}, Case{box(200, 30.0, 30.0), 190},
        Case{box(150, 15.0, 20.0), 80}, Case{box(210, 600.0, 600.0), 190},
        Case{box(1, 20.0, 25.0), 1}, Case{box(3, 60.0, 60.0), 3}}) {
    CAPTURE(scene.particles.count);
    CAPTURE(scene.box.x());
    const State<2> now = adapt_to_scene(before, scene, 3);
    REQUIRE(now.positions.size() == static_cast<std::size_t>(scene.particles.count));
    REQUIRE(now.velocities.size() == now.positions.size());
    CHECK(kept(before, now) >= least);
    CHECK(brute_force_overlap(model_of<2>(scene, 3), now) < 1e-12);
    CHECK_NOTHROW(Simulation<2>(model_of<2>(scene, 3), now).run_until(1.0));
  }
}

TEST_CASE("Adapted state: added particles have the temperature of the gas") {
  State<2> before = start_state<2>(box(10, 60.0, 60.0), 4);
  for (Vec2& v : before.velocities) v *= 3.0;
  const State<2> now = adapt_to_scene(before, box(1500, 60.0, 60.0), 4);
  double squares = 0.0;
  for (const Vec2& v : now.velocities) squares += v.squaredNorm();
  // 1490 pairs of normal numbers: T/9 = 1 +- 0.026; five of these.
  CHECK(squares / (2.0 * 1500) == doctest::Approx(9.0).epsilon(0.13));
}

TEST_CASE("Adapted state: without room at random places, the gas starts as the scene says") {
  const State<2> before = start_state<2>(box(200, 20.0, 25.0), 5);
  const Scene dense = box(450, 20.0, 25.0);  // phi = 0.71
  const State<2> now = adapt_to_scene(before, dense, 5);
  CHECK(now.positions == start_state<2>(dense, 5).positions);
}
