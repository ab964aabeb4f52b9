#pragma once

#include <array>
#include <optional>

#include "engine/dynamics/clock.h"
#include "engine/dynamics/run_state.h"
#include "engine/laws/acts.h"
#include "engine/laws/model.h"
#include "engine/physics/flight.h"
#include "engine/physics/wall_motion.h"

// Walls that move have a phase at the base, as a fraction of a period. The clock computes it again
// at every move of the base (Boundary). A change of frequency adds a shift to this phase, which
// keeps the wall at its place (RunState::phase_shifts). Contact with a ramp is a quadratic
// equation. Contact with a sine is found piece by piece between inflections, by Newton's method
// from the side where it cannot overshoot (wall_motion.cpp).

namespace clatter {

/// The motion of each wall, with its phase at simulation time 0. A wall with stroke 0 is at rest.
template <int D>
std::array<WallMotion, 2 * D> wall_motions(const Model<D>& model);

/// Whether flights continue under other laws: gravity, the shear rate, the motions of all walls and
/// the shapes of all fixtures are the same.
template <int D>
bool keeps_flights(const Model<D>& before, const Model<D>& after);

/// Whether the flights of a saved run continue under other laws: gravity, the shear rate and the
/// motions of all walls are the same. Its events are predicted again, so its fixtures may differ.
template <int D>
bool keeps_flights(const RunState<D>& saved, const Model<D>& after);

/// The walls of a run, at times on its moving base. A wall's place is the position of the centre of
/// a particle that touches it.
template <int D>
class Boundary {
 public:
  /// The walls of `model`, which must outlive this object. For the others see RunState.
  Boundary(const Model<D>& model, const Clock& clock,
           const std::array<double, 2 * D>& phase_shifts = {},
           const std::optional<PistonStroke>& piston = {}, double shear_phase = 0.0);

  /// Takes the changed walls of the model, at the clock's base. For the others see RunState.
  void restart(const Clock& clock, const std::array<double, 2 * D>& phase_shifts,
               const std::optional<PistonStroke>& piston, double shear_phase);
  /// Computes the phases of moving walls and of a sheared box, and the times of the piston, at the
  /// clock's new base.
  void move_base(const Clock& clock);
  /// The box and its images at time 0 on the base.
  const Domain<D>& domain() const { return domain_; }
  /// Added to the offset of a sheared box, see RunState.
  double shear_phase() const { return shear_phase_; }
  /// Replaces the stroke of the piston. Then the base must move.
  void begin(const PistonStroke& stroke) { piston_ = stroke; }
  /// The last stroke of the piston, at simulation times; absent: none yet.
  const std::optional<PistonStroke>& piston() const { return piston_; }

  /// Added to the phases of the walls, in periods.
  const std::array<double, 2 * D>& phase_shifts() const { return phase_shifts_; }
  /// Displacement into the box, velocity and acceleration of a wall along its inward normal.
  WallState wall(int side, double time) const;
  /// Coordinate, along the wall's axis, of a particle of some radius that touches the wall. The
  /// contact times use the same coordinate.
  double touching_place(int side, double radius, double time) const;
  /// Time, not before `now`, at which a particle of some radius touches a wall; kNever without a
  /// contact.
  double contact_time(int side, const Flight<D>& flight, double radius, double now) const;
  /// The same of a body whose flight has another acceleration.
  double contact_time(int side, const Flight<D>& flight, double radius, const Vec<D>& acceleration,
                      double now) const;
  /// Largest displacement of a wall into the box, until the next stroke of the piston.
  double innermost_travel(int side) const { return innermost_[side]; }

  /// +1 for the near wall of an axis, -1 for the far one: the direction into the box.
  static double inward(int side) { return side % 2 ? -1.0 : 1.0; }
  /// The unit vector of a wall into the box.
  static Vec<D> normal(int side) { return inward(side) * Vec<D>::Unit(side / 2); }

 private:
  const Model<D>& model_;
  Domain<D> domain_;
  double shear_phase_ = 0.0;
  std::array<double, 2 * D> phase_shifts_;
  std::array<std::optional<WallMotion>, 2 * D> motions_;  // of the walls that move
  std::optional<PistonStroke> piston_;
  PistonStroke stroke_;  // the same, at times on the base
  std::array<double, 2 * D> innermost_;
};

extern template class Boundary<2>;
extern template class Boundary<3>;

}  // namespace clatter
