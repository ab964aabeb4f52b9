#pragma once

#include <cstdint>
#include <optional>

#include "engine/dynamics/simulation.h"

namespace clatter {

/// A collision of a disk, with another or with a wall.
struct Encounter {
  double time = 0.0;                     ///< simulation time
  std::optional<std::uint32_t> partner;  ///< the other disk; absent: a wall
  int side = 0;                          ///< the Side, of a wall
};

/// Keeps the last collision of one disk.
class EncounterWatch : public Observer<2> {
 public:
  /// Of a simulation, which outlives it; it still is to be made an observer of that. Absent: of no
  /// disk.
  EncounterWatch(const Simulation<2>& simulation, std::optional<std::uint32_t> disk)
      : simulation_(simulation), disk_(disk) {}

  /// Of another disk from now on.
  void watch(std::optional<std::uint32_t> disk) {
    disk_ = disk;
    last_.reset();
  }

  void on_collision(const PairCollision<2>& collision) override;
  void on_wall(const WallCollision<2>& collision) override;

  /// Absent: none so far.
  const std::optional<Encounter>& last() const { return last_; }

 private:
  const Simulation<2>& simulation_;
  std::optional<std::uint32_t> disk_;
  std::optional<Encounter> last_;
};

/// The next collision of a disk under the laws in force, found by a copy of the run that goes
/// ahead; absent where it is too many events ahead to be looked for.
std::optional<Encounter> next_encounter(const Simulation<2>& simulation, std::uint32_t disk);

}  // namespace clatter
