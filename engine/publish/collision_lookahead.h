#pragma once

#include <cstdint>
#include <optional>

#include "engine/dynamics/simulation.h"

namespace clatter {

/// A collision of a particle, with another or with a wall.
struct ParticleCollision {
  double time = 0.0;                     ///< simulation time
  std::optional<std::uint32_t> partner;  ///< the other particle; absent: a wall
  int side = 0;                          ///< the Side, of a wall
};

/// Keeps the last collision of one particle.
template <int D>
class CollisionWatch : public Observer<D> {
 public:
  /// Of a simulation, which outlives it; it still is to be made an observer of that. Absent: of no
  /// particle.
  CollisionWatch(const Simulation<D>& simulation, std::optional<std::uint32_t> particle)
      : simulation_(simulation), particle_(particle) {}

  /// Of another particle from now on.
  void watch(std::optional<std::uint32_t> particle) {
    particle_ = particle;
    last_.reset();
  }

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;

  /// Absent: none so far.
  const std::optional<ParticleCollision>& last() const { return last_; }

 private:
  const Simulation<D>& simulation_;
  std::optional<std::uint32_t> particle_;
  std::optional<ParticleCollision> last_;
};

/// A copy of a run that goes ahead of it, under the laws in force, to see what a particle meets
/// next. Where both go on it has as much work as the run itself.
template <int D>
class CollisionLookahead {
 public:
  /// Sets out from where the simulation is.
  CollisionLookahead(const Simulation<D>& simulation, std::uint32_t particle);
  CollisionLookahead(const CollisionLookahead&) = delete;
  CollisionLookahead& operator=(const CollisionLookahead&) = delete;

  /// The particle's first collision after a time, no earlier than the last that was asked for;
  /// absent where it is not within so many steps more, or where there is none.
  const std::optional<ParticleCollision>& next_after(double time, std::uint64_t most_steps);

 private:
  Simulation<D> ahead_;
  std::uint32_t particle_;
  CollisionWatch<D> watch_;
  bool ended_ = false;  // time stands still before another
};

}  // namespace clatter
