#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "engine/initial/mixture_state.h"
#include "engine/initial/overlap_removal.h"
#include "tests/engine/support/gas.h"
#include "tests/support/dimensions.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A box, periodic or closed, that particles of these radii fill to a fraction.
template <int D>
Model<D> box_for(const std::vector<Grain>& grains, double fraction, bool closed) {
  Model<D> model;
  model.diameter = 0.0;
  double volume = 0.0;
  for (const Grain& grain : grains) {
    model.diameter = std::max(model.diameter, 2.0 * grain.radius);
    volume +=
        (D == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi) * std::pow(grain.radius, D);
  }
  model.box.setConstant(std::pow(volume / fraction, 1.0 / D));
  if (closed) model.walls.fill(Wall{});
  return model;
}

/// Sizes that are spread evenly, and few large particles among small ones.
std::vector<Grain> polydisperse(int count) {
  std::vector<Grain> grains;
  for (int i = 0; i < count; ++i) {
    const double radius = 0.25 + 0.5 * (i + 0.5) / count;
    grains.push_back({.radius = radius, .mass = radius});
  }
  return grains;
}
std::vector<Grain> large_among_small(int count) {
  std::vector<Grain> grains(static_cast<std::size_t>(count));
  for (int i = 0; i < count; i += 50) grains[static_cast<std::size_t>(i)].radius = 3.0;
  return grains;
}

/// Periodic disks in a square that they fill to a fraction, with the sweeps that removal needs. It
/// looks for a pause before each.
struct Removal {
  int sweeps = 0;
  bool found = false;
  std::vector<double> progress;
};
Removal removal_of(const std::vector<Grain>& grains, double fraction) {
  std::vector<double> radii;
  for (const Grain& grain : grains) radii.push_back(grain.radius);
  Random random(8, Stream::Placement, 0, 0);
  OverlapRemoval<2> work(box_for<2>(grains, fraction, false).domain(), grains, random);
  Removal result;
  bool pauses = false;
  result.progress.push_back(work.progress());
  while (!work.advance([&] { return pauses = !pauses; })) {
    ++result.sweeps;
    result.progress.push_back(work.progress());
  }
  result.found = !work.take().empty();
  return result;
}

}  // namespace

TEST_CASE_TEMPLATE("Overlap removal: dense particles of any sizes find places in the box",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const double fraction = D == 2 ? 0.75 : 0.55;
  for (const bool closed : {false, true}) {
    CAPTURE(closed);
    for (const std::vector<Grain>& grains : {polydisperse(400), large_among_small(400)}) {
      const Model<D> model = box_for<D>(grains, closed ? 0.7 * fraction : fraction, closed);
      const State<D> state = mixture_state<D>(model, grains, 2.0, 5);
      REQUIRE(state.positions.size() == grains.size());
      CHECK(finite_and_inside(model, state));
      CHECK(brute_force_overlap(model, state) == 0.0);
      double energy = 0.0;
      Vec<D> momentum = Vec<D>::Zero();
      std::vector<double> radii, asked;
      for (std::size_t i = 0; i < state.grains.size(); ++i) {
        energy += state.grains[i].mass * state.velocities[i].squaredNorm();
        momentum += state.grains[i].mass * state.velocities[i];
        radii.push_back(state.grains[i].radius);
        asked.push_back(grains[i].radius);
      }
      CHECK(energy == doctest::Approx(2.0 * D * 400.0).epsilon(1e-12));
      CHECK(momentum.norm() < 1e-10);
      std::ranges::sort(radii);
      std::ranges::sort(asked);
      CHECK(radii == asked);
    }
  }
}

TEST_CASE("Overlap removal: particles without room get no places") {
  const std::vector<Grain> grains(100);
  CHECK(mixture_state<2>(box_for<2>(grains, 0.95, false), grains, 1.0, 6).positions.empty());
  // The overlaps soon fall no more.
  const Removal removal = removal_of(grains, 0.95);
  CHECK_FALSE(removal.found);
  CHECK(removal.sweeps < 4000);
}

TEST_CASE("Overlap removal: polydisperse disks find places close to random close packing") {
  std::vector<Grain> grains(900);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    grains[i].radius = 0.3 + 0.4 * (static_cast<double>(i) + 0.5) / 900.0;
  }
  const Removal removal = removal_of(grains, 0.8);
  CHECK(removal.found);
  CHECK(removal.sweeps > 10);
  CHECK(removal.progress.front() == 0.0);
  CHECK(removal.progress[5] > 0.1);
  CHECK(removal.progress[5] < 1.0);
  for (const double part : removal.progress) CHECK((part >= 0.0 && part <= 1.0));
}

// Particles that begin deep in a large one would leave it by its radius over a diameter, and each
// push others, for hundreds of sweeps.
TEST_CASE("Overlap removal: particles do not begin within a large one") {
  std::vector<Grain> grains(5000);
  grains[2500].radius = 20.0;
  const Removal removal = removal_of(grains, 0.3);
  CHECK(removal.found);
  CHECK(removal.sweeps < 60);
}

// The large particles have the lowest numbers, and read several lists.
TEST_CASE("Overlap: a large particle that overlaps a small one is refused, wherever they are") {
  std::vector<Grain> grains(200);
  for (std::size_t i = 0; i < 4; ++i) grains[i].radius = 3.0;
  const Model<2> model = box_for<2>(grains, 0.2, false);
  State<2> state = mixture_state<2>(model, grains, 1.0, 7);
  std::vector<std::size_t> large, small;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    (state.grains[i].radius > 1.0 ? large : small).push_back(i);
  }
  for (const bool first : {false, true}) {
    for (int k = 0; k < 40; ++k) {
      State<2> wrong = state;
      const std::size_t i = large[static_cast<std::size_t>(k) % large.size()];
      const std::size_t j = small[static_cast<std::size_t>(k)];
      const double angle = 0.3 * k;
      wrong.positions[j] =
          model.domain().wrapped(wrong.positions[i] + 3.4 * Vec2(std::cos(angle), std::sin(angle)));
      if (first) std::swap(wrong.positions[0], wrong.positions[i]);
      if (first) std::swap(wrong.grains[0], wrong.grains[i]);
      REQUIRE(brute_force_overlap(model, wrong) > 1e-3);
      CHECK_THROWS_AS(Simulation<2>(model, wrong), PhysicalStop);
    }
  }
}
