#pragma once

#include <span>

#include "engine/physics/spin.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Flags of sums that fields need.
using Needs = unsigned;

/// The flags of the sums, see the members of MomentLayout.
namespace sum {
inline constexpr Needs kMomentum = 1, kSquares = 2, kShears = 4, kEnergyFlux = 8, kSpin = 16,
                       kSpinEnergy = 32, kTransfer = 64, kEnergyTransfer = 128, kDissipation = 256;
}  // namespace sum

/// Layout of a cell's row of sums (theory 8): the index of each sum, or kAbsent. Only the sums that
/// the requested fields need are stored. The order is: kinetic sums, over particles and time; sums
/// over events, spread along a branch vector; and the sums at the ends of a branch vector.
template <int D>
struct MomentLayout {
  static constexpr int kAbsent = -1;

  int count = 0;                  ///< 1: the number of particles, always kept
  int mass = 0;                   ///< 1: sum m; of particles that are alike the count
  int momentum = kAbsent;         ///< D: sum m v_k
  int squares = kAbsent;          ///< D: sum m v_k^2
  int shears = kAbsent;           ///< D(D-1)/2: sum m v_k v_l, k < l
  int energy_flux = kAbsent;      ///< D: sum (m v^2 + I omega^2)/2 v_k
  int spin = kAbsent;             ///< of Spin<D>: sum omega
  int spin_energy = kAbsent;      ///< 1: sum I omega^2 / 2
  int common = 1;                 ///< end of the kinetic sums of all particles
  int species = kAbsent;          ///< species_count * species_size: sums of each species
  int species_count = 0;          ///< number of species, from the first, that have sums
  int species_size = 0;           ///< numbers of each: the first ones of a row
  int kinetic = 1;                ///< end of the kinetic sums
  int transfer = kAbsent;         ///< D^2, [k][l]: sum r_12,k dp_1,l
  int energy_transfer = kAbsent;  ///< D: sum (dE_1 - dE_2)/2 r_12,k; at walls dE_1 (r_1 - r_w)_k
  int along_branch = 1;           ///< end of the sums spread along branch vectors
  int dissipation = kAbsent;      ///< 1: sum (dE_1 + dE_2)/2, at either end
  int drag = kAbsent;             ///< D of each species: sum dp by other species, at its end
  int drag_count = 0;             ///< number of species, from the first, that have a drag
  int size = 1;                   ///< numbers in a row

  /// Index of the first sum of a species.
  int of_species(int number) const { return species + number * species_size; }
};

/// The layout for these fields. `spins`: whether the particles spin, and so carry energy of spin.
/// `mixed`: whether particles have their own masses.
template <int D>
MomentLayout<D> moment_layout(std::span<const Field> fields, bool spins, bool mixed);

extern template MomentLayout<2> moment_layout<2>(std::span<const Field>, bool, bool);
extern template MomentLayout<3> moment_layout<3>(std::span<const Field>, bool, bool);

}  // namespace clatter
