#include "engine/publish/collision_lookahead.h"

#include "engine/error.h"

namespace clatter {

void CollisionWatch::on_collision(const PairCollision<2>& collision) {
  const std::uint32_t first = collision.particles[0].particle,
                      second = collision.particles[1].particle;
  if (first != particle_ && second != particle_) return;
  last_ = {simulation_.time(), first == particle_ ? second : first, 0};
}

void CollisionWatch::on_wall(const WallCollision<2>& collision) {
  if (collision.particle.particle == particle_)
    last_ = {simulation_.time(), std::nullopt, collision.side};
}

CollisionLookahead::CollisionLookahead(const Simulation<2>& simulation, std::uint32_t particle)
    : ahead_(simulation.model(), simulation.save()), particle_(particle), watch_(ahead_, particle) {
  ahead_.add_observer(watch_);
}

const std::optional<ParticleCollision>& CollisionLookahead::next_after(double time,
                                                                       std::uint64_t most_steps) {
  const EventCounts& counts = ahead_.counts();
  const std::uint64_t last_step = counts.steps() + most_steps;
  const auto passed = [&] { return watch_.last() && watch_.last()->time <= time; };
  if (passed()) watch_.watch(particle_);
  try {
    while (!ended_ && !watch_.last() && counts.steps() < last_step) {
      // It arrives at the end of time where nothing is to happen any more.
      ended_ = ahead_.run_until(kNever, counts.collisions() + 1, last_step);
      if (passed()) watch_.watch(particle_);
    }
  } catch (const PhysicalStop&) {
    ended_ = true;
  }
  return watch_.last();
}

}  // namespace clatter
