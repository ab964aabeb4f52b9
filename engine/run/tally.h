#pragma once

#include <cstdint>

#include "engine/measure/totals.h"
#include "engine/vec.h"

namespace clatter {

/// Sums since a run's start. The difference of two tallies gives the sums between them.
struct Tally {
  double time = 0.0;                       ///< covered by the sums
  VecX temperature_integral;               ///< time integrals of T_x, T_y and, for spheres, T_z
  double spin_temperature_integral = 0.0;  ///< time integral of the spin temperature
  double walls_in = 0.0;                   ///< energy input of the walls
  double bulk_in = 0.0;                    ///< energy input of kicks
  double nudges_in = 0.0;                  ///< energy input of nudges and puffs
  double gravity_in = 0.0;                 ///< work of gravity
  double shear_in = 0.0;                   ///< work of the shear
  double dissipated = 0.0;                 ///< energy lost between particles, > 0
  double undissipated = 0.0;               ///< additional loss without t_c
  std::uint64_t collisions = 0;            ///< between particles
  std::uint64_t elasticised = 0;           ///< of these, made elastic by t_c
};

/// The tally of a run in `dimension` dimensions at its start.
Tally empty_tally(int dimension);

/// Adds the totals of the window that follows the tally.
template <int D>
void add(Tally& tally, const WindowTotals<D>& window);

/// Visits all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, Tally& tally) {
  auto& [time, temperature_integral, spin_temperature_integral, walls_in, bulk_in, nudges_in,
         gravity_in, shear_in, dissipated, undissipated, collisions, elasticised] = tally;
  io(time, temperature_integral, spin_temperature_integral, walls_in, bulk_in, nudges_in,
     gravity_in, shear_in, dissipated, undissipated, collisions, elasticised);
}

}  // namespace clatter
