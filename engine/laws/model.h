#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/laws/domain.h"
#include "engine/laws/wall.h"
#include "engine/vec.h"

namespace clatter {

/// Homogeneous driving: periodic kicks of all particles at once (theory 5.1).
struct BulkDrive {
  double interval = 1.0;    ///< time between kicks, > 0
  double kick_speed = 0.0;  ///< standard deviation of a kick per velocity component; mean removed
  double kick_spin = 0.0;   ///< standard deviation of the change of spin
};

/// The laws of a run. Simulation::set_laws changes them.
template <int D>
struct Model {
  Vec<D> box = Vec<D>::Zero();                   ///< edge lengths
  std::array<std::optional<Wall>, 2 * D> walls;  ///< indexed by Side; a pair absent: periodic
  double diameter = 1.0;
  double restitution = 1.0;  ///< alpha of collisions between particles
  Roughness roughness;       ///< of the particles
  double inertia = 0.5;      ///< q = 4I/(m a^2)
  bool spins = false;        ///< whether particles have spins: they or walls are or were rough
  Vec<D> gravity = Vec<D>::Zero();      ///< acceleration of every particle
  std::optional<BulkDrive> bulk_drive;  ///< absent: none
  std::optional<double> contact_time;   ///< t_c of the TC model; absent: off
  std::uint64_t seed = 1;               ///< of every random number of the run

  /// Whether collisions of particles take energy from the gas.
  bool dissipates() const { return restitution < 1.0 || !roughness.conserves(); }
  /// Whether there is gravity, so that particles fly along parabolas.
  bool has_gravity() const { return (gravity.array() != 0.0).any(); }
  /// Time between kicks; 0 without bulk driving.
  double kick_interval() const { return bulk_drive ? bulk_drive->interval : 0.0; }
  /// Whether the box is periodic along an axis.
  bool periodic(int axis) const { return !walls[2 * axis]; }
  /// The box and its periodic images.
  Domain<D> domain() const {
    Domain<D> domain{.box = box};
    for (int axis = 0; axis < D; ++axis) domain.periodic[axis] = periodic(axis);
    return domain;
  }
  /// Coordinate of the centre of a particle that touches a wall at its rest position. `end` is 0
  /// for the near wall of the axis and 1 for the far wall.
  double wall_plane(int axis, int end) const {
    return end ? box[axis] - 0.5 * diameter : 0.5 * diameter;
  }
};

}  // namespace clatter
