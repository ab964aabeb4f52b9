#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Numbers of collisions of particles in consecutive intervals: of each particle with others, and
/// of the pairs that collided. Tables "collision_counts.particle" and "..pair", means
/// "..mean_number" and "..number_variance" of particles, and "..mean_per_pair". Memory is bounded:
/// in a gas of more than 2048 particles, only the pairs of some particles with all others are
/// followed.
template <int D>
class CollisionCounts final : public Observable, public Observer<D> {
 public:
  /// Counts the collisions of `simulation`.
  explicit CollisionCounts(Simulation<D>& simulation);

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  void sample() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

  /// Upper estimate of the memory of the counters in a gas of `particles`, in bytes.
  static double memory(double particles);

 private:
  void on_collision(const PairCollision<D>& collision) override;
  void count_pair(std::size_t low, std::size_t high);
  std::size_t counters() const;

  Simulation<D>& simulation_;
  std::size_t count_;                          // of particles
  std::size_t stride_;                         // the pairs of each stride_-th particle are followed
  std::vector<std::uint32_t> numbers_;         // [N] of each particle in the interval
  std::vector<std::uint32_t> pairs_;           // [followed particles][N] in the interval
  std::vector<std::uint64_t> collided_;        // indices of pairs_ that are not 0
  std::optional<Observation<D>> observation_;  // present after the start
};

extern template class CollisionCounts<2>;
extern template class CollisionCounts<3>;

}  // namespace clatter
