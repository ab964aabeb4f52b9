#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/initial/start_state.h"
#include "engine/measure/measurement.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/support/allocations.h"

using namespace clatter;
using namespace clatter::testing;

// A feature that a scene does not use is not stored, has no events and changes nothing.

namespace {

// Cost of the construction of an object.
template <class Make>
std::size_t bytes_of(const Make& make) {
  const std::size_t before = allocated_bytes();
  make();
  return allocated_bytes() - before;
}

}  // namespace

TEST_CASE("Absent parts: a smooth gas holds no spins, and without t_c no times of collisions") {
  constexpr std::size_t kCount = 10000;
  const Scene smooth = gas(150.0, 150.0, kCount, 0.9);
  const State<2> start = start_state<2>(smooth, 121);
  const auto simulation_bytes = [&](const Model<2>& model) {
    return bytes_of([&] { Simulation<2>(model, start); });
  };
  Model<2> model = model_of<2>(smooth, 121);
  CHECK(Simulation<2>(model, start).spins().capacity() == 0);
  const std::size_t bare = simulation_bytes(model);
  model.contact_time = 1e-6;
  CHECK(simulation_bytes(model) == bare + kCount * sizeof(double));
  model.contact_time.reset();
  model.spins = true;
  CHECK(simulation_bytes(model) == bare + kCount * sizeof(Spin<2>));
}

TEST_CASE("Absent parts: without fields there is no grid") {
  constexpr std::size_t kGrid = 1000 * 1000 * sizeof(double);
  Scene scene = gas(20.0, 20.0, 50, 0.9);
  scene.measure.burn_in = 0.0;
  scene.measure.cells = {1000, 1000};
  const auto measured_bytes = [&] {
    return bytes_of([&] {
      const auto simulation = simulation_of<2>(scene, 122);
      Measurement measurement(*simulation, scene.measure, 2.0);
      simulation->run_until(2.0);
      measurement.result();
    });
  };
  CHECK(measured_bytes() < kGrid / 10);
  scene.measure.fields = {Quantity::Density};
  CHECK(measured_bytes() > kGrid);
}

TEST_CASE("Absent parts: a part that is there but switched off changes no bit") {
  const std::string scene =
      "box.size = [20, 25]\nparticles = { count = 100, restitution = 0.9 }\n"
      "walls.left = { kind = 'driven', drive_speed = 1 }\nwalls.right = { kind = 'static' }\n";
  const auto hash_of = [&](const std::vector<Override>& changes) {
    const auto simulation = simulation_of<2>(parse_scene(scene, "s.toml", changes), 124);
    simulation->run_until(50.0);
    return simulation->state_hash();
  };
  const std::uint64_t plain = hash_of({});
  for (const Override& change : {Override{"gravity.acceleration", "[0, 0]"},
                                 {"particles.friction", "0"},
                                 {"particles.tangential_restitution", "-1"},
                                 {"walls.right.friction", "0"},
                                 {"walls.right.tangential_restitution", "-1"},
                                 {"collapse.contact_time", "1e-300"},
                                 {"measure.fields", "['stress']"},
                                 {"view.field", "'density'"}}) {
    CAPTURE(change.key);
    CHECK(hash_of({change}) == plain);
  }
  CHECK(hash_of({{"particles.friction", "0.1"}}) != plain);
}
