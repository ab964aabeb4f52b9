#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "engine/dynamics/simulation.h"
#include "engine/initial/memory.h"
#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/allocations.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// Compares the most bytes of each particle with the estimate, while an elastic gas is made and
// collides twice per particle.
template <int D>
void check_memory(double fraction) {
  constexpr int kCount = 40000;
  CAPTURE(fraction);
  Scene scene = default_scene(D);
  scene.particles.count = kCount;
  scene.box.setConstant(std::pow(kCount * packing_fraction(D, 1.0) / fraction, 1.0 / D));
  const double estimate = gas_memory(scene).total() / kCount;
  const std::size_t before = bytes_in_use();
  State<D> start = start_state<D>(scene, 5);
  restart_most_bytes_in_use();
  Simulation<D> simulation(model_of<D>(scene, 5), std::move(start));
  simulation.run_until(kNever, kCount);
  const double most = static_cast<double>(most_bytes_in_use() - before) / kCount;
  MESSAGE(D << " dimensions, " << fraction << ": " << most << " of " << estimate);
  CHECK(most <= estimate);
  CHECK(most >= 0.85 * estimate);
}

}  // namespace

TEST_CASE("Memory: the making and the run of a gas take at most the estimate") {
  for (const double fraction : {0.05, 0.3, 0.5, 0.7}) check_memory<2>(fraction);
  for (const double fraction : {0.05, 0.3, 0.49}) check_memory<3>(fraction);
}
