// Possible gain from two cores in one run: the number of successive independent collisions, and the
// waiting time of one core for the other.

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <thread>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/run/scheduled_run.h"
#include "tests/bench/table.h"

using namespace clatter;

namespace {

class Places : public Observer<2> {
 public:
  void on_collision(const PairCollision<2>& collision) override {
    places.push_back(collision.particles[0].position);
  }
  std::vector<Vec2> places;
};

// Whether two collisions are so near that the second may depend on the first.
bool depend(const Vec2& a, const Vec2& b, const Vec2& box) {
  constexpr double kReach = 4.0;  // diameters
  Vec2 x = a - b;
  for (int axis = 0; axis < 2; ++axis) x[axis] -= std::round(x[axis] / box[axis]) * box[axis];
  return x.norm() < kReach;
}

// Mean number of successive, mutually independent collisions.
double independent_collisions(int count, double area_fraction) {
  Scene scene;
  scene.particles.count = count;
  scene.box.setConstant(std::sqrt(count * 0.25 * std::numbers::pi / area_fraction));
  const auto simulation = simulation_of<2>(scene, 1);
  constexpr std::uint64_t kCollisions = 200'000;
  simulation->run_until(kNever, 10 * static_cast<std::uint64_t>(count));
  Places watched;
  simulation->add_observer(watched);
  simulation->run_until(kNever, simulation->counts().pair_collisions + kCollisions);
  const std::vector<Vec2>& places = watched.places;
  int groups = 1;
  std::size_t first = 0;
  for (std::size_t next = 1; next < places.size(); ++next) {
    for (std::size_t k = first; k < next; ++k) {
      if (!depend(places[next], places[k], scene.box)) continue;
      first = next;
      ++groups;
      break;
    }
  }
  return static_cast<double>(places.size()) / groups;
}

// Seconds from a write on one core until another core reads it.
double hand_over() {
  constexpr int kTurns = 200'000;
  std::atomic<int> turn = 0;
  const auto take_turns = [&turn](int first) {
    for (int mine = first; mine < 2 * kTurns; mine += 2) {
      while (turn.load(std::memory_order_acquire) != mine) {
      }
      turn.store(mine + 1, std::memory_order_release);
    }
  };
  const double taken = bench::seconds([&] {
    turn = 0;
    const std::jthread other(take_turns, 1);
    take_turns(0);
  });
  return taken / (2 * kTurns);
}

}  // namespace

int main() {
  std::printf("hand-over between cores: %.0f ns\n", 1e9 * hand_over());
  std::printf("%10s %10s %24s\n", "particles", "phi", "independent collisions");
  for (const int count : {1'000, 10'000, 100'000}) {
    std::printf("%10d %10.1f %24.1f\n", count, 0.5, independent_collisions(count, 0.5));
  }
}
