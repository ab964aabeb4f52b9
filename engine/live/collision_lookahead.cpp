#include "engine/live/collision_lookahead.h"

#include "engine/error.h"

namespace clatter {

template <int D>
void CollisionWatch<D>::on_collision(const PairCollision<D>& collision) {
  const std::uint32_t first = collision.particles[0].particle,
                      second = collision.particles[1].particle;
  if (first != particle_ && second != particle_) return;
  last_ = {simulation_.time(), first == particle_ ? second : first};
}

template <int D>
void CollisionWatch<D>::on_wall(const WallCollision<D>& collision) {
  if (collision.particle.particle != particle_) return;
  last_ = {simulation_.time(), std::nullopt, collision.side};
  if (collision.at_wall()) return;
  last_->fixture =
      collision.at_piston() ? "piston" : simulation_.model().fixtures[collision.fixture].name;
}

template <int D>
CollisionLookahead<D>::CollisionLookahead(const Simulation<D>& simulation, std::uint32_t particle)
    : ahead_(typename Simulation<D>::InParts(), simulation.model(), simulation.save()),
      particle_(particle),
      watch_(ahead_, particle) {
  ahead_.add_observer(watch_);
}

template <int D>
const std::optional<ParticleCollision>& CollisionLookahead<D>::next_after(
    double time, std::uint64_t most_steps, const StopRequest& pause) {
  const EventCounts& counts = ahead_.counts();
  const std::uint64_t last_step = counts.steps() + most_steps;
  const auto passed = [&] { return watch_.last() && watch_.last()->time <= time; };
  if (passed()) watch_.watch(particle_);
  try {
    while (searches() && counts.steps() < last_step && !pause.made()) {
      // run_until(kNever) returns true only if no event is left.
      ended_ = ahead_.run_until(kNever, counts.collisions() + 1, last_step, pause);
      if (passed()) watch_.watch(particle_);
    }
  } catch (const PhysicalStop&) {
    ended_ = true;
  }
  return watch_.last();
}

template class CollisionWatch<2>;
template class CollisionWatch<3>;
template class CollisionLookahead<2>;
template class CollisionLookahead<3>;

}  // namespace clatter
