#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/initial/adapt_to_scene.h"
#include "engine/initial/start_state.h"
#include "tests/engine/support/gas.h"
#include "tests/support/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A gas between driven walls along x.
template <int D>
Scene box(int count, const Vec<D>& size) {
  Scene scene = default_scene(D);
  scene.box = size;
  scene.particles.count = count;
  scene.particles.restitution = 0.9;
  wall_in(scene, 0, kDriven);
  return scene;
}

template <int D>
Scene rough_box(int count, const Vec<D>& size) {
  Scene scene = box<D>(count, size);
  scene.particles.roughness.friction = 0.5;
  scene.particles.start.spin_temperature = 1.0;
  return scene;
}

/// Pairs of old and new indices of the particles that kept their positions and velocities.
template <int D>
std::vector<std::pair<std::size_t, std::size_t>> kept(const State<D>& before, const State<D>& now) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < now.positions.size(); ++i) {
    for (std::size_t j = 0; j < before.positions.size(); ++j) {
      const bool same = (now.positions[i] - before.positions[j]).norm() < 1e-12 &&
                        now.velocities[i] == before.velocities[j];
      if (same) pairs.emplace_back(j, i);
    }
  }
  return pairs;
}

/// A scene, and the least number of particles that keep their positions in it.
struct Adaptation {
  Scene scene;
  std::size_t least;
};

template <int D>
void check_places(const Scene& first, const std::vector<Adaptation>& cases) {
  const State<D> before = start_state<D>(first, 3);
  for (const auto& [scene, least] : cases) {
    CAPTURE(scene.particles.count);
    CAPTURE(scene.box.transpose());
    const State<D> now = adapt_to_scene(before, scene, 3);
    REQUIRE(now.positions.size() == static_cast<std::size_t>(scene.particles.count));
    REQUIRE(now.velocities.size() == now.positions.size());
    CHECK(kept(before, now).size() >= least);
    CHECK(brute_force_overlap(model_of<D>(scene, 3), now) < 1e-12);
    CHECK_NOTHROW(Simulation<D>(model_of<D>(scene, 3), now).run_until(1.0));
  }
}

template <int D>
void check_spins(const Vec<D>& size) {
  const State<D> before = start_state<D>(rough_box<D>(40, size), 6);
  const State<D> now = adapt_to_scene(before, rough_box<D>(60, size), 6);
  REQUIRE(now.spins.size() == 60);
  const auto pairs = kept(before, now);
  CHECK(pairs.size() == 40);
  for (const auto& [then, here] : pairs) CHECK(now.spins[here] == before.spins[then]);
  CHECK(std::ranges::count(now.spins, Spin<D>::Zero().eval()) == 20);
  CHECK(adapt_to_scene(before, box<D>(60, size), 6).spins.empty());
}

/// T/9 = 1 +- `width` of 1490 vectors of normal numbers; five of these.
template <int D>
void check_adapted_temperature(const Vec<D>& size, double width) {
  State<D> before = start_state<D>(box<D>(10, size), 4);
  for (Vec<D>& v : before.velocities) v *= 3.0;
  const State<D> now = adapt_to_scene(before, box<D>(1500, size), 4);
  double squares = 0.0;
  for (const Vec<D>& v : now.velocities) squares += v.squaredNorm();
  CHECK(squares / (D * 1500.0) == doctest::Approx(9.0).epsilon(5.0 * width));
}

template <int D>
void check_no_room(const Vec<D>& size, int thin, int dense) {
  const State<D> before = start_state<D>(box<D>(thin, size), 5);
  const Scene scene = box<D>(dense, size);
  const State<D> now = adapt_to_scene(before, scene, 5);
  CHECK(now.positions == start_state<D>(scene, 5).positions);
}

/// Small particles, and large ones of unequal sizes.
template <int D>
Scene mixed_box(int small, int large, const Vec<D>& size) {
  Scene scene = box<D>(small + large, size);
  scene.species.resize(2);
  scene.species[0].name = "small";
  scene.species[0].count = small;
  scene.species[1].name = "large";
  scene.species[1].count = large;
  scene.species[1].diameter = 1.6;
  scene.species[1].polydispersity = Polydispersity{Spread::Uniform, 0.2};
  return scene;
}

}  // namespace

TEST_CASE("Adapted state: particles that fit stay, others are added, none overlap") {
  check_places<2>(box<2>(200, {20.0, 25.0}), {{box<2>(200, {20.0, 25.0}), 200},
                                              {box<2>(300, {20.0, 25.0}), 200},
                                              {box<2>(120, {20.0, 25.0}), 120},
                                              {box<2>(200, {30.0, 30.0}), 190},
                                              {box<2>(150, {15.0, 20.0}), 80},
                                              {box<2>(210, {600.0, 600.0}), 190},
                                              {box<2>(1, {20.0, 25.0}), 1},
                                              {box<2>(3, {60.0, 60.0}), 3}});
  check_places<3>(box<3>(120, {7.0, 7.0, 7.0}), {{box<3>(120, {7.0, 7.0, 7.0}), 120},
                                                 {box<3>(160, {7.0, 7.0, 7.0}), 120},
                                                 {box<3>(70, {7.0, 7.0, 7.0}), 70},
                                                 {box<3>(120, {9.0, 8.0, 10.0}), 110},
                                                 {box<3>(80, {6.0, 5.0, 5.0}), 25},
                                                 {box<3>(125, {60.0, 60.0, 60.0}), 110},
                                                 {box<3>(1, {7.0, 7.0, 7.0}), 1},
                                                 {box<3>(3, {20.0, 20.0, 20.0}), 3}});
}

TEST_CASE("Adapted state: particles that stay keep their spins, others have none") {
  check_spins<2>({12.0, 10.0});
  check_spins<3>({6.0, 5.0, 5.5});
}

TEST_CASE("Adapted state: added particles have the temperature of the gas") {
  check_adapted_temperature<2>({60.0, 60.0}, 0.026);
  check_adapted_temperature<3>({20.0, 20.0, 20.0}, 0.021);
}

TEST_CASE("Adapted state: without room at random places, the gas starts as the scene says") {
  check_no_room<2>({20.0, 25.0}, 200, 450);     // phi = 0.71
  check_no_room<3>({7.0, 6.0, 7.0}, 120, 250);  // phi = 0.45
}

// A larger box and the same one keep every particle. A smaller one keeps those inside.
TEST_CASE("Adapted state: particles of a mixture stay, with their sizes") {
  const Scene first = mixed_box<2>(90, 20, {20.0, 18.0});
  check_places<2>(first, {{mixed_box<2>(90, 20, {20.0, 18.0}), 110},
                          {mixed_box<2>(90, 20, {26.0, 18.0}), 104},
                          {mixed_box<2>(120, 20, {20.0, 18.0}), 110},
                          {mixed_box<2>(50, 20, {20.0, 18.0}), 70},
                          {mixed_box<2>(90, 20, {18.0, 16.0}), 70}});
  check_places<3>(
      mixed_box<3>(90, 20, {8.0, 9.0, 8.0}),
      {{mixed_box<3>(90, 20, {8.0, 9.0, 8.0}), 110}, {mixed_box<3>(60, 25, {8.0, 9.0, 8.0}), 80}});
  const State<2> before = start_state<2>(first, 3);
  const State<2> now = adapt_to_scene(before, mixed_box<2>(90, 20, {26.0, 18.0}), 3);
  for (const auto& [then, here] : kept(before, now)) {
    CHECK(now.grains[here] == before.grains[then]);
  }
  CHECK(std::ranges::is_sorted(now.grains, {}, &Grain::species));
}

// Kinetic energies (m/2) v^2: T = 4 +- 5 standard errors of 500 particles, .063 each.
TEST_CASE("Adapted state: added particles of a mixture have the temperature of the gas") {
  State<2> before = start_state<2>(mixed_box<2>(20, 4, {60.0, 60.0}), 4);
  for (Vec2& v : before.velocities) v *= 2.0;
  const State<2> now = adapt_to_scene(before, mixed_box<2>(20, 504, {60.0, 60.0}), 4);
  REQUIRE(now.grains.size() == 524);
  const auto pairs = kept(before, now);
  double squares = 0.0;
  for (std::size_t i = 0; i < now.grains.size(); ++i) {
    const bool stayed = std::ranges::any_of(pairs, [&](const auto& p) { return p.second == i; });
    if (!stayed) squares += now.grains[i].mass * now.velocities[i].squaredNorm();
  }
  const auto added = static_cast<double>(now.grains.size() - pairs.size());
  CHECK(squares / (2.0 * added) == doctest::Approx(4.0).epsilon(5.0 / std::sqrt(added)));
}

TEST_CASE("Adapted state: a mixture without room starts as the scene says") {
  const State<2> before = start_state<2>(mixed_box<2>(60, 10, {20.0, 18.0}), 5);
  const Scene scene = mixed_box<2>(60, 100, {20.0, 18.0});  // phi = 0.69
  CHECK(adapt_to_scene(before, scene, 5).positions == start_state<2>(scene, 5).positions);
}
