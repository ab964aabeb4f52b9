#include <doctest/doctest.h>

#include <algorithm>

#include "engine/checkpoint/archive.h"
#include "engine/observables/periodic_images.h"
#include "engine/run/scheduled_run.h"
#include "tests/support/dimensions.h"
#include "tests/support/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// A gas that falls through a periodic box of unequal sides.
template <int D>
Scene falling_gas() {
  Scene scene = gas(VecX::LinSpaced(D, 6.0, 8.0), 20, 0.9);
  scene.gravity = VecX::LinSpaced(D, 0.05, -0.02);
  return scene;
}

// Sum of the unwrapped positions.
template <int D>
Vec<D> centre(const Simulation<D>& simulation, const PeriodicImages<D>& images) {
  const State<D> state = simulation.state();
  const std::vector<IntVec<D>> boxes = images.images();
  Vec<D> sum = Vec<D>::Zero();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    sum += state.positions[i] + simulation.domain().shift(boxes[i].template cast<double>());
  }
  return sum;
}

template <int D>
Vec<D> total_momentum(const Simulation<D>& simulation) {
  Vec<D> sum = Vec<D>::Zero();
  for (const Vec<D>& velocity : simulation.state().velocities) sum += velocity;
  return sum;
}

}  // namespace

// Collisions conserve momentum. So the unwrapped centre of mass falls freely, although particles
// cross the sides of the box many times, in collisions too. A lost image is an error of at least 6.
TEST_CASE_TEMPLATE("Periodic images: the unwrapped centre of mass falls freely", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Scene scene = falling_gas<D>();
  const auto simulation = simulation_of<D>(scene, 5);
  PeriodicImages<D> images(*simulation);
  const Vec<D> start = centre(*simulation, images), speed = total_momentum(*simulation);
  const Vec<D> force = 20.0 * Vec<D>(*scene.gravity);
  for (const double time : {0.0, 1.0, 20.0, 100.0}) {
    CAPTURE(time);
    simulation->run_until(time);
    const Vec<D> moved = centre(*simulation, images) - start;
    CHECK((moved - speed * time - 0.5 * force * time * time).norm() < 1e-8);
  }
  int most = 0;
  for (const IntVec<D>& image : images.images()) most = std::max(most, image.cwiseAbs().maxCoeff());
  CHECK(most > 10);
  CHECK(simulation->counts().pair_collisions > 200);
}

// In a sheared box the particles are seen from the images in which they began. Momentum is
// conserved between images that slide too. At t = 40 the rate changes, where the flow of each image
// does.
TEST_CASE_TEMPLATE("Periodic images: the unwrapped centre of a sheared gas moves straight on",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Scene scene = gas(VecX::LinSpaced(D, 6.0, 8.0), 20, 0.9);
  scene.shear_rate = 0.8;
  const auto simulation = simulation_of<D>(scene, 5);
  PeriodicImages<D> images(*simulation);
  const Vec<D> start = centre(*simulation, images), speed = total_momentum(*simulation);
  for (const double time : {0.0, 1.0, 10.0, 40.0}) {
    CAPTURE(time);
    simulation->run_until(time);
    CHECK((centre(*simulation, images) - start - speed * time).norm() < 1e-8);
  }
  const Vec<D> middle = centre(*simulation, images);
  scene.shear_rate = -0.3;
  simulation->set_laws(model_of<D>(scene, 5));
  CHECK((centre(*simulation, images) - middle).norm() < 1e-8);
  const Vec<D> before = centre(*simulation, images);
  simulation->run_until(41.0);
  const Vec<D> changed = centre(*simulation, images) - before;
  simulation->run_until(60.0);
  CHECK((centre(*simulation, images) - before - 20.0 * changed).norm() < 1e-8);
  CHECK(simulation->counts().pair_collisions > 200);

  // A run that is resumed under another rate has its particles where they were.
  const Vec<D> end = centre(*simulation, images);
  ArchiveWriter writer;
  writer(images);
  for (const double rate : {0.0, 2.0, -5.0}) {
    scene.shear_rate = rate;
    Simulation<D> resumed(model_of<D>(scene, 5), simulation->save());
    PeriodicImages<D> read(resumed);
    ArchiveReader reader(writer.written(), "");
    reader(read);
    CHECK((centre(resumed, read) - end).norm() < 1e-8);
  }
}

TEST_CASE_TEMPLATE("Periodic images: a resumed run has them, also under other laws", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  Scene scene = falling_gas<D>();
  const auto simulation = simulation_of<D>(scene, 6);
  PeriodicImages<D> images(*simulation);
  simulation->run_until(30.0);
  ArchiveWriter writer;
  writer(images);

  Simulation<D> resumed(model_of<D>(scene, 6), simulation->save());
  PeriodicImages<D> read(resumed);
  ArchiveReader reader(writer.written(), "");
  reader(read);
  reader.finish();
  CHECK(read.images() == images.images());

  const Vec<D> start = centre(*simulation, images), speed = total_momentum(*simulation);
  scene.gravity = VecX::LinSpaced(D, -0.3, 0.2);
  resumed.set_laws(model_of<D>(scene, 6));
  CHECK(read.images() == images.images());
  resumed.run_until(60.0);
  const Vec<D> force = 20.0 * Vec<D>(*scene.gravity);
  const Vec<D> moved = centre(resumed, read) - start;
  CHECK((moved - 30.0 * speed - 450.0 * force).norm() < 1e-8);
}
