#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/particle.h"
#include "engine/laws/model.h"
#include "engine/physics/pair_contact.h"
#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// All data of particles that physical events change.
template <int D>
struct ParticleStates {
  ParticleArray<D> particles;          ///< [N] stored states
  LargeArray<Spin<D>> spins;           ///< [N] angular velocities; empty without spins
  LargeArray<double> last_collisions;  ///< [N] times on the base; empty without a t_c
  LargeArray<Vec<D>> remainders;       ///< [N] rounding errors of positions; empty unless the
                                       ///< box is longer than kLongBox

  /// Distinguishes flights of one number, which has 32 bits, for random numbers: the collisions and
  /// kicks before the base, divided by 2^31. A number comes again after two eras or more.
  std::uint32_t era = 0;

  /// Copies the data of a particle, but not its image.
  void copy(std::uint32_t to, const ParticleStates& source, std::uint32_t from) {
    particles.copy(to, source.particles[from]);
    if (!spins.empty()) spins[to] = source.spins[from];
    if (!last_collisions.empty()) last_collisions[to] = source.last_collisions[from];
    if (!remainders.empty()) remainders[to] = source.remainders[from];
  }
  /// Gives the optional arrays the length that the model needs for a number of particles. New
  /// elements mean no spin, no collision and no error.
  void fit(const Model<D>& model, std::size_t count) {
    spins.resize(model.spins ? count : 0, Spin<D>::Zero());
    last_collisions.resize(model.contact_time ? count : 0, -kNever);
    remainders.resize(model.box.maxCoeff() > kLongBox * model.diameter ? count : 0, Vec<D>::Zero());
  }
};

}  // namespace clatter
