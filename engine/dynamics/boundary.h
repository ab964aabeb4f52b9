#pragma once

#include <array>
#include <optional>

#include "engine/dynamics/clock.h"
#include "engine/dynamics/model.h"
#include "engine/physics/flight.h"
#include "engine/physics/wall_motion.h"

namespace clatter {

/// How each wall moves, with its phase at simulation time 0; one without stroke stays in its place.
template <int D>
std::array<WallMotion, 2 * D> wall_motions(const Model<D>& model);

/// Where the walls of a run are, at times on its moving base. Places are those of the centres of
/// particles that touch.
template <int D>
class Boundary {
 public:
  /// The walls of a model, which outlives this.
  Boundary(const Model<D>& model, const Clock& clock);

  /// Takes up the phases that moving walls have at the clock's new base.
  void move_base(const Clock& clock);

  /// Displacement into the box, velocity and acceleration of a wall along its inward normal.
  WallState wall(int side, double time) const;
  /// Coordinate along the wall's axis of a particle that touches it, as the contact times have it.
  double touching_place(int side, double time) const;
  /// Time at which a flight that is under way at `now` touches a wall, or kNever.
  double contact_time(int side, const Flight<D>& flight, double now) const;
  /// The farthest from its place that a wall comes into the box.
  double innermost_travel(int side) const;

  /// +1 for the near wall of an axis, -1 for the far one: the direction into the box.
  static double inward(int side) { return side % 2 ? -1.0 : 1.0; }

 private:
  const Model<D>& model_;
  std::array<std::optional<WallMotion>, 2 * D> motions_;  // of the walls that move
};

extern template class Boundary<2>;
extern template class Boundary<3>;

}  // namespace clatter
