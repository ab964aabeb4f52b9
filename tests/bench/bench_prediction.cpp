// Time of one full prediction (all neighbours, walls, borders), for a single particle and for two
// at once, by area fraction and number of particles.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include "engine/dynamics/cell_grid.h"
#include "engine/dynamics/prediction.h"
#include "engine/physics/random.h"
#include "tests/bench/table.h"

using namespace clatter;

// Particles on a square lattice in a periodic box, with Gaussian velocities.
static ParticleArray<2> lattice(int side, double edge) {
  ParticleArray<2> particles(static_cast<std::size_t>(side * side));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    Random random(1, Stream::Velocity, static_cast<std::uint32_t>(i), 0);
    const int n = static_cast<int>(i);
    particles.flight(i).r = Vec2(n % side + 0.5, n / side + 0.5) * (edge / side);
    particles.flight(i).v = {random.normal(), random.normal()};
  }
  return particles;
}

struct Taken {
  double alone;        // seconds for the plan of one particle
  double two_at_once;  // seconds for each of two
};

static Taken time_plans(int side, double area_fraction) {
  Model<2> model;
  const double edge = side * std::sqrt(std::numbers::pi / (4.0 * area_fraction));
  model.box = {edge, edge};
  const ParticleArray<2> particles = lattice(side, edge);
  Neighbourhood<2> near(model, static_cast<double>(particles.size()));
  std::vector<Plan<2>> plans(particles.size());
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    plans[i].cell = near.place(i, particles[i].flight.r);
  }
  const Clock clock({0.0, 0.0});
  const Boundary<2> boundary(model, clock);
  const Prediction<2> prediction(model, boundary, particles, near);
  const int rounds = 400000 / static_cast<int>(particles.size()) + 1;
  const auto count = static_cast<std::uint32_t>(particles.size() / 2 * 2);
  const double alone = bench::seconds([&] {
    for (int round = 0; round < rounds; ++round) {
      for (std::uint32_t i = 0; i < count; ++i) prediction.plan({i, &plans[i]}, 0.0);
    }
  });
  const double two_at_once = bench::seconds([&] {
    for (int round = 0; round < rounds; ++round) {
      for (std::uint32_t i = 0; i < count; i += 2) {
        prediction.plan({i, &plans[i]}, {i + 1, &plans[i + 1]}, 0.0);
      }
    }
  });
  const double made = static_cast<double>(rounds) * count;
  return {alone / made, two_at_once / made};
}

int main() {
  std::printf("%10s %10s %18s %18s\n", "particles", "phi", "ns/plan, alone", "two at once");
  for (const int side : {30, 100, 400}) {
    for (const double area_fraction : {0.1, 0.4, 0.7}) {
      const Taken taken = time_plans(side, area_fraction);
      std::printf("%10d %10.1f %18.1f %18.1f\n", side * side, area_fraction, 1e9 * taken.alone,
                  1e9 * taken.two_at_once);
    }
  }
}
