#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "engine/dynamics/memory.h"
#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/allocations.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// The most bytes of each particle while an elastic gas is made and collides twice per particle.
template <int D>
double most_bytes(int count, double fraction, double& estimate) {
  Scene scene = default_scene(D);
  scene.particles.count = count;
  scene.box.setConstant(std::pow(count * packing_fraction(D, 1.0) / fraction, 1.0 / D));
  estimate = gas_memory(scene).total() / count;
  const std::size_t before = bytes_in_use();
  State<D> start = start_state<D>(scene, 5);
  restart_most_bytes_in_use();
  Simulation<D> simulation(model_of<D>(scene, 5), std::move(start));
  simulation.run_until(kNever, static_cast<std::uint64_t>(count));
  return static_cast<double>(most_bytes_in_use() - before) / count;
}

}  // namespace

TEST_CASE("Memory: the making and the run of a gas take at most the estimate") {
  constexpr int kCount = 40000;
  for (const double fraction : {0.05, 0.3, 0.5, 0.7}) {
    CAPTURE(fraction);
    double estimate = 0.0;
    const double most = most_bytes<2>(kCount, fraction, estimate);
    MESSAGE("disks " << fraction << ": " << most << " of " << estimate);
    CHECK(most <= estimate);
    CHECK(most >= 0.85 * estimate);
  }
  for (const double fraction : {0.05, 0.3, 0.49}) {
    CAPTURE(fraction);
    double estimate = 0.0;
    const double most = most_bytes<3>(kCount, fraction, estimate);
    MESSAGE("spheres " << fraction << ": " << most << " of " << estimate);
    CHECK(most <= estimate);
    CHECK(most >= 0.85 * estimate);
  }
}
