#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/dynamics/simulation.h"

namespace clatter {

/// A collision of a particle with another particle, with a wall or with a fixture.
struct ParticleCollision {
  double time = 0.0;                     ///< simulation time
  std::optional<std::uint32_t> partner;  ///< the other particle; absent: a wall or a fixture
  int side = 0;                          ///< Side of the wall, if there is no partner
  std::string fixture = {};              ///< name of the fixture; empty: a wall
};

/// Observer that keeps the last collision of one particle.
template <int D>
class CollisionWatch : public Observer<D> {
 public:
  /// `simulation` must outlive this object; the caller adds this object to its observers. An absent
  /// particle: watches none.
  CollisionWatch(const Simulation<D>& simulation, std::optional<std::uint32_t> particle)
      : simulation_(simulation), particle_(particle) {}

  /// Watches another particle from now on, without a last collision.
  void watch(std::optional<std::uint32_t> particle) {
    particle_ = particle;
    last_.reset();
  }

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;

  /// The last collision; absent: none so far.
  const std::optional<ParticleCollision>& last() const { return last_; }

 private:
  const Simulation<D>& simulation_;
  std::optional<std::uint32_t> particle_;
  std::optional<ParticleCollision> last_;
};

/// A copy of a run that runs ahead of it under the current laws, to find a particle's next
/// collision. While the run continues, the copy costs as much work as the run itself.
template <int D>
class CollisionLookahead {
 public:
  /// Starts from the simulation's current state.
  CollisionLookahead(const Simulation<D>& simulation, std::uint32_t particle);
  CollisionLookahead(const CollisionLookahead&) = delete;
  CollisionLookahead& operator=(const CollisionLookahead&) = delete;

  /// False after a nudge of the run or a stroke of its piston, which the copy lacks.
  bool follows(const Simulation<D>& simulation) const {
    return simulation.counts().nudges == ahead_.counts().nudges &&
           simulation.counts().strokes == ahead_.counts().strokes;
  }
  /// The particle's first collision after `time`; times of successive calls must not decrease.
  /// Absent if the next `most_steps` steps do not reach it, at a request to pause, or if there is
  /// none.
  const std::optional<ParticleCollision>& next_after(double time, std::uint64_t most_steps,
                                                     const StopRequest& pause);
  /// Whether further steps may find the collision.
  bool searches() const { return !ended_ && !watch_.last(); }
  /// Steps of the copy, and of the run before it.
  std::uint64_t steps() const { return ahead_.counts().steps(); }

 private:
  Simulation<D> ahead_;
  std::uint32_t particle_;
  CollisionWatch<D> watch_;
  bool ended_ = false;  // no further collision: no event is left, or a PhysicalStop
};

}  // namespace clatter
