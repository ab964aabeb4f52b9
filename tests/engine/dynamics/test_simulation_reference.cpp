#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/initial/mixture_state.h"
#include "engine/initial/start_state.h"
#include "engine/physics/theory.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/support/dimensions.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

template <int D>
struct Case {
  std::string name;
  Model<D> model;
  std::vector<int> counts;  // numbers of particles
};

// The state after 2000 collisions must equal the reference to the last bit.
template <int D>
void compare(const Model<D>& model, const State<D>& start, std::uint64_t collisions = 2000) {
  Simulation<D> simulation(model, start);
  run_beside_reference(simulation, start, collisions);
  // Moving walls leave the planes in which the reference looks for them.
  const bool walls_move =
      std::ranges::any_of(model.walls, [](const auto& wall) { return wall && wall->moves(); });
  if (!walls_move) CHECK(brute_force_overlap(model, simulation.state()) < 1e-12);
  check_sound(simulation);
}

template <int D>
void compare(const Case<D>& c) {
  for (const int count : c.counts) {
    CAPTURE(c.name);
    CAPTURE(count);
    compare(c.model, clear_gas(c.model, count, 81));
  }
}

}  // namespace

TEST_CASE("Reference: periodic boxes") {
  compare(Case<2>{"wide", periodic_box(9.0, 8.0), {2, 3, 7, 16, 30}});
  compare(Case<2>{"dense", periodic_box(6.2, 6.1), {30}});
  compare(Case<2>{"one particle high: contacts through images that are not the nearest",
                  periodic_box(12.0, 1.2),
                  {2, 3, 6}});
  compare(Case<2>{"two particles high", periodic_box(7.0, 2.05), {2, 5, 9}});
  compare(Case<2>{"two cells wide", periodic_box(2.2, 9.0), {2, 8, 12}});
  compare(Case<2>{"one cell in all", periodic_box(1.9, 2.05), {2}});
  compare(Case<2>{"inelastic", inelastic(periodic_box(9.0, 8.0), 0.9), {2, 12, 30}});
}

TEST_CASE("Reference: walls on two sides and on four") {
  compare(Case<2>{"static", with_walls(periodic_box(9.0, 8.0), 0, kStatic), {2, 12, 30}});
  compare(Case<2>{"four static",
                  with_walls(with_walls(periodic_box(7.0, 8.0), 0, kStatic), 1, kStatic),
                  {2, 12, 30}});
  compare(Case<2>{
      "driven", inelastic(with_walls(periodic_box(9.0, 8.0), 0, kDriven), 0.9), {2, 3, 12, 30}});
  compare(
      Case<2>{"driven, lossy across",
              inelastic(with_walls(with_walls(periodic_box(9.0, 8.0), 0, kDriven), 1, kLossy), 0.8),
              {2, 3, 12, 30}});
  compare(Case<2>{
      "thermal", inelastic(with_walls(periodic_box(9.0, 8.0), 1, kThermal), 0.7), {2, 3, 12, 30}});
  compare(Case<2>{"driven, periodic across and narrow",
                  inelastic(with_walls(periodic_box(12.0, 1.2), 0, kDriven), 0.9),
                  {2, 5}});
  compare(Case<2>{"thermal, periodic across and two particles high",
                  inelastic(with_walls(periodic_box(9.0, 2.05), 0, kThermal), 0.9),
                  {2, 5, 12}});
  compare(Case<2>{"a channel that holds one particle across",
                  with_walls(periodic_box(12.0, 1.5), 1, kStatic),
                  {2, 6}});
}

TEST_CASE("Reference: wholly inelastic particles between driven walls") {
  const Model<2> model = inelastic(with_walls(periodic_box(9.0, 8.0), 0, kDriven), 0.0);
  for (const int count : {2, 5, 20}) compare(model, random_gas(model, count, 82));
}

namespace {

// Particles on a square or cubic lattice of spacing 2, four along each axis, whose velocities
// along the axes repeat: several pairs collide at the same times.
template <int D>
State<D> lattice_start() {
  State<D> start;
  for (int i = 0; i < 1 << 2 * D; ++i) {
    Vec<D> place, velocity = Vec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) place[axis] = 1.0 + 2.0 * (i >> 2 * axis & 3);
    const int direction = (i + i / 4 + i / 16) % (2 * D);
    velocity[direction % D] = direction < D ? 1.0 : -1.0;
    start.positions.push_back(place);
    start.velocities.push_back(velocity);
  }
  return start;
}

template <int D>
void compare_simultaneous(std::uint64_t collisions) {
  for (const bool closed : {false, true}) {
    for (const double restitution : {1.0, 0.5}) {
      Model<D> model = inelastic(periodic_box<D>(Vec<D>::Constant(8.0)), restitution);
      if (closed) model = with_walls(with_walls(model, 0, kDriven), 1, kStatic);
      compare(model, lattice_start<D>(), collisions);
    }
  }
}

// The second particle crosses the box many times before it meets the first.
template <int D>
void compare_late_contact(const Vec<D>& box, const State<D>& start, double least) {
  const Model<D> model = periodic_box<D>(box);
  Simulation<D> simulation(model, start);
  const BaseMoves<D> moves(simulation);
  Reference<D> reference(model, start, moves);
  simulation.run_until(kNever, 1);
  reference.run_until_collisions(1);
  CHECK(simulation.time() > least);
  CHECK(simulation.state_hash() == state_hash<D>(reference.state()));
  check_sound(simulation);
}

}  // namespace

TEST_CASE("Reference: simultaneous collisions") {
  compare_simultaneous<2>(2000);
}

TEST_CASE("Reference: simultaneous collisions of spheres") {
  compare_simultaneous<3>(200);
}

TEST_CASE("Reference: a first contact after many box lengths") {
  compare_late_contact<2>({10.0, 9.0}, {{{1.0, 1.0}, {4.0, 6.0}}, {{0.0, 0.0}, {1.0, -0.001}}},
                          1000.0);
  compare_late_contact<3>({10.0, 9.0, 8.0},
                          {{{1.0, 1.0, 1.0}, {4.0, 6.0, 5.0}}, {{0, 0, 0}, {1.0, -0.01, 0.008}}},
                          200.0);
}

// The reference tests all images that a pair can reach. A pair in a wide box passes thousands of
// images before it meets, so that boxes of spheres are small.
template <int D>
void compare_shortly(const Model<D>& model, const std::vector<int>& counts) {
  for (const int count : counts) {
    CAPTURE(count);
    compare<D>(model, clear_gas(model, count, 83), 300);
  }
}

TEST_CASE("Reference: spheres in periodic boxes") {
  compare_shortly(periodic_box(2.2, 2.3, 2.1), {2, 3});
  compare_shortly(periodic_box(4.0, 5.0, 3.5), {12, 30});
  compare_shortly(periodic_box(3.1, 3.2, 3.3), {20});    // crowded
  compare_shortly(periodic_box(4.0, 3.0, 1.2), {3, 9});  // one sphere in height
  compare_shortly(periodic_box(1.9, 2.05, 1.95), {2});   // a single cell
  compare_shortly(inelastic(periodic_box(4.0, 5.0, 3.5), 0.9), {12, 30});
}

TEST_CASE("Reference: dense spheres, which have lists of their own") {
  Scene scene = default_scene(3);
  scene.particles.count = 32;
  scene.box.setConstant(std::cbrt(32.0 * packing_fraction(3, 1.0) / 0.5));
  const Model<3> model = model_of<3>(scene, 84);
  compare<3>(model, start_state<3>(scene, 84), 300);
  compare<3>(inelastic(model, 0.9), start_state<3>(scene, 85), 300);
}

TEST_CASE("Reference: spheres between walls of every kind, along every axis") {
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    for (const Wall& wall : {kStatic, kDriven, kThermal, kSawtooth, kSinusoidal}) {
      CAPTURE(static_cast<int>(wall.kind));
      compare_shortly(with_walls(periodic_box(3.0, 3.2, 2.9), axis, wall), {2, 5});
      compare_shortly(inelastic(with_walls(periodic_box(4.0, 4.2, 3.9), axis, wall), 0.8), {15});
    }
  }
}

TEST_CASE("Reference: spheres between four walls and six") {
  const auto lengthwise = [](const Model<3>& box, const Wall& wall) {
    return inelastic(with_walls(with_walls(box, 0, kDriven), 1, wall), 0.8);
  };
  compare_shortly(lengthwise(periodic_box(3.0, 3.2, 2.9), kLossy), {2, 5});
  compare_shortly(lengthwise(periodic_box(4.0, 4.2, 3.9), kThermal), {15});
  compare_shortly(lengthwise(periodic_box(4.0, 4.2, 1.2), kLossy), {5});  // one sphere between
  for (const Wall& wall :
       {kStatic, kLossy, kDriven, kRoughDriven, kThermal, kSawtooth, kSinusoidal}) {
    CAPTURE(static_cast<int>(wall.kind));
    compare_shortly(inelastic(rough(walled(periodic_box(4.0, 4.2, 3.9), wall), 0.4, 0.6), 0.9),
                    {1, 2, 15});
  }
  // A channel and a slit that hold one sphere across.
  compare_shortly(with_walls(with_walls(periodic_box(6.0, 1.5, 1.4), 1, kStatic), 2, kStatic),
                  {2, 4});
  compare_shortly(with_walls(periodic_box(4.0, 5.0, 1.5), 2, kStatic), {2, 8});
}

TEST_CASE("Reference: wholly inelastic spheres between driven walls") {
  const Model<3> model = inelastic(with_walls(periodic_box(4.0, 4.5, 4.0), 0, kDriven), 0.0);
  for (const int count : {2, 5, 20}) compare(model, random_gas(model, count, 82), 300);
}

TEST_CASE("Reference: spheres under gravity, kicked, rough, and with a t_c") {
  const Model<3> small = with_walls(periodic_box(2.5, 2.6, 2.7), 2, kDriven);
  const Model<3> wide = with_walls(periodic_box(4.0, 4.5, 4.0), 2, kDriven);
  compare_shortly(inelastic(falling(small, {0.1, -0.2, -0.5}), 0.9), {2, 4});
  compare_shortly(inelastic(falling(wide, {0.1, -0.2, -0.5}), 0.9), {15, 30});
  compare_shortly(inelastic(kicked(periodic_box(2.5, 2.6, 2.7), 0.25, 0.5), 0.8), {2, 4});
  compare_shortly(inelastic(kicked(periodic_box(4.0, 4.5, 4.0), 0.25, 0.5), 0.8), {30});
  compare_shortly(inelastic(rough(small, 0.4, 0.6), 0.9), {2, 4});
  compare_shortly(inelastic(rough(wide, 0.4, 0.6), 0.9), {15, 30});
  compare_shortly(rough(wide, kInfinity, 1.0), {15});
  compare_shortly(with_contact_time(inelastic(small, 0.5), 0.02), {2, 4});
  compare_shortly(with_contact_time(inelastic(wide, 0.5), 0.02), {15, 30});
  compare_shortly(everything<3>(), {2, 3, 15, 30});
}

namespace {

// Three species in a model, with the laws of the model for all and with their own.
template <int D>
void compare_mixtures(const Model<D>& model, const std::vector<int>& counts, double ratio,
                      std::uint64_t collisions) {
  CAPTURE(ratio);
  for (const int count : counts) {
    CAPTURE(count);
    compare<D>(model, mixed_gas(model, count, 86, ratio), collisions);
    if (count == 2) continue;  // two inelastic particles soon miss each other for ever
    compare<D>(with_species(model), mixed_gas(model, count, 87, ratio), collisions);
  }
}

}  // namespace

TEST_CASE("Reference: mixtures of disks") {
  for (const double ratio : {1.4, 4.0, 20.0}) {
    compare_mixtures(periodic_box(9.0, 8.0), {2, 12, 30}, ratio, 500);
    compare_mixtures(inelastic(periodic_box(2.2, 9.0), 0.9), {2, 9}, ratio, 500);
    compare_mixtures(periodic_box(12.0, 1.2), {2, 3, 6}, ratio, 500);
    for (const Wall& wall : {kStatic, kLossy, kDriven, kThermal, kSawtooth, kSinusoidal}) {
      CAPTURE(static_cast<int>(wall.kind));
      compare_mixtures(inelastic(four(wall, kStatic), 0.9), {3, 20}, ratio, 500);
    }
    compare_mixtures(everything<2>(), {2, 3, 15}, ratio, 500);
  }
}

TEST_CASE("Reference: mixtures of spheres") {
  for (const double ratio : {1.4, 4.0, 20.0}) {
    compare_mixtures(periodic_box(4.0, 5.0, 3.5), {3, 30}, ratio, 300);
    compare_mixtures(everything<3>(), {2, 12}, ratio, 300);
    for (const Wall& wall : {kStatic, kDriven, kThermal, kSawtooth, kSinusoidal}) {
      CAPTURE(static_cast<int>(wall.kind));
      compare_mixtures(inelastic(with_walls(periodic_box(3.0, 3.2, 2.9), 1, wall), 0.8), {5}, ratio,
                       300);
    }
  }
}

// A fraction of .77 if all 44 had the largest diameter, and of .47 with the middle one: dense
// enough for lists of particles, whichever of these the cells are as wide as.
TEST_CASE("Reference: dense mixtures of spheres, which have lists of their own") {
  for (const double alpha : {1.0, 0.9}) {
    Model<3> model = inelastic(periodic_box(3.1, 3.1, 3.1), alpha);
    const State<3> kinds = mixed_gas(model, 6, 89, 1.4);
    std::vector<Grain> grains;
    for (std::size_t i = 0; i < 44; ++i) grains.push_back(kinds.grains[i % 3]);
    model = with_species(model);
    compare<3>(model, mixture_state<3>(model, grains, 1.0, 90), 1000);
  }
}

// Up to 128 kinds of particles have numbers in the rows of particles; beyond, each has its radius
// in an array.
TEST_CASE_TEMPLATE("Reference: gases of as many kinds as particles", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = inelastic(periodic_box<D>(Vec<D>::Constant(D == 2 ? 14.0 : 6.0)), 0.9);
  for (const std::size_t count : {128, 129}) {
    CAPTURE(count);
    std::vector<Grain> grains;
    for (std::size_t i = 0; i < count; ++i) {
      const double radius = 0.5 - 0.25 * static_cast<double>(i) / static_cast<double>(count);
      grains.push_back({.radius = radius, .mass = 8.0 * radius * radius * radius});
    }
    compare<D>(model, mixture_state<D>(model, grains, 1.0, 91), 60);
  }
}

// Kicks differ by mass only under two of the laws.
TEST_CASE("Reference: mixtures under kicks of every law") {
  for (const KickLaw law : {KickLaw::Velocity, KickLaw::Energy, KickLaw::Momentum}) {
    Model<2> model = kicked(inelastic(periodic_box(9.0, 8.0), 0.9), 0.25, 0.5);
    model.bulk_drive->law = law;
    compare_mixtures(model, {2, 20}, 2.0, 1000);
  }
}

// Two species that differ in nothing have the bits of one.
TEST_CASE_TEMPLATE("Reference: species that are alike have the bits of one species", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = everything<D>();
  const State<D> start = clear_gas(model, 12, 88);
  Model<D> several = model;
  several.species =
      SpeciesLaws<D>{.pairs = {4, {model.restitution, model.roughness}}, .walls = {2, model.walls}};
  State<D> named = start;
  for (std::uint32_t i = 0; i < 12; ++i) {
    Grain grain = model.grain();
    grain.species = i % 2;
    named.grains.push_back(grain);
  }
  Simulation<D> one(model, start), two(several, named);
  one.run_until(kNever, 1000);
  two.run_until(kNever, 1000);
  CHECK(two.state_hash() == one.state_hash());
}
