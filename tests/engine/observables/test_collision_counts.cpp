#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// The collisions of each particle and pair since the last clear().
template <int D>
class Counts : public Observer<D> {
 public:
  explicit Counts(int particles) : particles(static_cast<std::size_t>(particles), 0.0) {}
  void on_collision(const PairCollision<D>& collision) override {
    const auto [low, high] =
        std::minmax(collision.particles[0].particle, collision.particles[1].particle);
    particles[low] += 1.0;
    particles[high] += 1.0;
    pairs[{low, high}] += 1.0;
  }
  void clear() {
    std::ranges::fill(particles, 0.0);
    pairs.clear();
  }

  std::vector<double> particles;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> pairs;
};

// Measures a gas, and counts again. Pairs are those of every `stride`-th particle with others.
template <int D>
void check_counts(const Scene& scene, double interval, int intervals, std::size_t stride) {
  Measure measure;
  measure.collision_counts = {.interval = interval};
  const Measured measured =
      observed<D>(scene, measure, ObservableKind::CollisionCounts, intervals * interval, 3);
  const auto simulation = simulation_of<D>(scene, 3);
  Counts<D> counts(scene.particles.count);
  simulation->add_observer(counts);
  std::vector<double> particles, pairs;
  for (int k = 1; k <= intervals; ++k) {
    simulation->run_until(k * interval);
    particles.insert(particles.end(), counts.particles.begin(), counts.particles.end());
    for (const auto& [pair, number] : counts.pairs) {
      if (pair.first % stride == 0 || pair.second % stride == 0) pairs.push_back(number);
    }
    counts.clear();
  }
  check_numbers(measured, "collision_counts.particle", "collision_counts.mean_number",
                "collision_counts.number_variance", particles);
  check_numbers(measured, "collision_counts.pair", "collision_counts.mean_per_pair", "", pairs);
}

}  // namespace

TEST_CASE_TEMPLATE("Collision counts: particles and pairs have the collisions of each interval",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Scene scene = gas(D == 2 ? VecX(Vec2(9.0, 7.0)) : VecX(Vec<3>(5.0, 4.0, 6.0)), 30, 0.9);
  wall_in(scene, 0, {.kind = WallKind::Thermal, .temperature = 1.0});
  check_counts<D>(scene, 3.0, 20, 1);
}

// 2^22 counters are enough for the pairs of 1398 of 3000 particles with all others, so those of
// each third are followed.
TEST_CASE("Collision counts: large gases follow the pairs of some particles") {
  check_counts<2>(gas(120.0, 110.0, 3000, 1.0), 4.0, 2, 3);
}
