#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "engine/dynamics/simulation.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/reference.h"
#include "tests/extremes/figure.h"

using namespace clatter;
using namespace clatter::testing;

// Walls much faster or much slower than the particles, with large strokes or high frequencies.
// tests/engine/physics/test_wall_motion.cpp tests that a contact is the first root.

namespace {

struct Figures {
  double deepest = 0.0;
  std::uint64_t hits = 0;
};

// Compares 10 particles with brute force.
void shake(const Model<2>& model, std::uint64_t collisions, Figures& figures) {
  const State<2> start = clear_gas(model, 10, 956);
  Simulation<2> simulation(model, start);
  run_beside_reference(simulation, start, collisions);
  CHECK(simulation.checks().clock_steps_back < 1e-13);
  // Brute force supports walls at their rest positions only. It tests all pairs of particles.
  Model<2> open = model;
  for (auto& wall : open.walls) wall.reset();
  open.box.array() += 20.0;
  figures.deepest =
      std::max({figures.deepest, simulation.checks().deepest_overlap, simulation.deepest_overlap(),
                brute_force_overlap(open, simulation.state())});
  figures.hits += simulation.counts().wall_collisions;
}

void report(const Figures& figures) {
  MESSAGE(figures.hits, " wall hits, deepest overlap ", brief(figures.deepest));
  CHECK(figures.hits > 500);
  CHECK(figures.deepest < 1e-10);
}

constexpr WallKind kMoving[] = {WallKind::Sawtooth, WallKind::Sinusoidal};

Model<2> between(WallKind kind, double stroke, double frequency, double length = 12.0) {
  const Wall wall{.kind = kind, .restitution = 0.9, .stroke = stroke, .frequency = frequency};
  Wall other = wall;
  other.phase = 0.375;
  Model<2> model = inelastic(periodic_box(length, 11.0), 0.8);
  model.walls[kLeft] = wall;
  model.walls[kRight] = other;
  return model;
}

// Short and long strokes, at given wall speeds.
void shake_at(std::initializer_list<double> speeds) {
  Figures figures;
  for (const WallKind kind : kMoving) {
    for (const double speed : speeds) {
      for (const double stroke : {1e-3, 0.5})
        shake(between(kind, stroke, speed / stroke), 500, figures);
    }
  }
  report(figures);
}

}  // namespace

TEST_CASE("Shaken: walls 10^3, 10^6 times as fast as the particles" *
          doctest::description(
              "the same bits as brute force, no particle beyond a wall, overlap below 1e-10")) {
  shake_at({1e3, 1e6});
}

TEST_CASE("Shaken: walls 10^-3, 10^-6 times as fast as the particles" *
          doctest::description(
              "the same bits as brute force, no particle beyond a wall, overlap below 1e-10")) {
  shake_at({1e-3, 1e-6});
}

TEST_CASE("Shaken: a frequency of 10^6 at strokes of 1e-6 to .1" *
          doctest::description(
              "the same bits as brute force, no particle beyond a wall, overlap below 1e-10")) {
  Figures figures;
  for (const WallKind kind : kMoving) {
    for (const double stroke : {1e-6, 1e-4, 0.1}) shake(between(kind, stroke, 1e6), 500, figures);
  }
  report(figures);
}

TEST_CASE("Shaken: the longest strokes that fit into the box" *
          doctest::description(
              "the same bits as brute force, no particle beyond a wall, overlap below 1e-10")) {
  Figures figures;
  for (const WallKind kind : kMoving) {
    for (const double frequency : {0.01, 1.0, 100.0}) {
      // Two columns of particles remain free when both walls are farthest inside. In the second
      // case a lone particle just fits in front of one wall.
      const double reach = kind == WallKind::Sawtooth ? 1.0 : 2.0;
      shake(between(kind, 4.9 * reach, frequency), 500, figures);
      Model<2> narrow = between(kind, 10.9 * reach, frequency);
      narrow.walls[kRight] = kStatic;
      const State<2> start{{{11.45, 5.0}}, {{-0.25, 0.125}}};
      Simulation<2> lone(narrow, start);
      lone.run_until(kNever, 2000);
      figures.hits += lone.counts().wall_collisions;
      figures.deepest =
          std::max({figures.deepest, lone.checks().deepest_overlap, lone.deepest_overlap()});
    }
  }
  report(figures);
}
