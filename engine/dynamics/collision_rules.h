#pragma once

#include <cstdint>

#include "engine/dynamics/boundary.h"
#include "engine/laws/model.h"
#include "engine/physics/collision.h"
#include "engine/physics/grain.h"
#include "engine/physics/spin.h"

namespace clatter {

/// Result of a collision of two particles.
template <int D>
struct PairOutcome {
  Exchange<D> gain;           ///< of both particles
  bool elasticised = false;   ///< whether the TC model made the collision elastic
  double undissipated = 0.0;  ///< energy that the TC model saved from dissipation
};

/// Outcome for two particles that touch, with the arguments of rough_impulse. With `elastic`
/// nothing dissipates (TC model, theory 5.3).
template <int D>
PairOutcome<D> pair_outcome(const ContactLaw& law, const Partners& partners, const Vec<D>& x,
                            const Vec<D>& v, const Spin<D>& surface, bool elastic);

/// State of a particle just before it hits a wall.
template <int D>
struct Arrival {
  Vec<D> velocity = Vec<D>::Zero();
  Spin<D> spin = Spin<D>::Zero();
  std::uint32_t particle = 0;
  std::uint64_t flight = 0;  ///< number of the flight that ends here, with its era in the high word
  Grain grain;               ///< what the particle is
};

/// State of a particle just after it hits a wall.
template <int D>
struct Departure {
  Vec<D> velocity = Vec<D>::Zero();
  Spin<D> spin = Spin<D>::Zero();
};

/// Departure of a particle that touches a wall or a fixture with a law. `normal` is the unit vector
/// at the contact, towards the particle; `wall` is the wall's state at that time. With `elastic`
/// (TC model, theory 5.4) alpha_w becomes at least 1 and beta_w -1. The drive stays.
template <int D>
Departure<D> wall_outcome(const Model<D>& model, const Wall& law, const Vec<D>& normal,
                          const WallState& wall, const Arrival<D>& arrival, bool elastic);

/// Result of a hit on the free piston.
template <int D>
struct PistonOutcome {
  Departure<D> departure;  ///< of the particle
  double momentum = 0.0;   ///< along the axis, lost by the piston
};

/// Outcome for a particle that touches the free piston, which moves at a velocity (theory 13.8).
/// `side` is 1 for a particle above the piston along its axis, and -1 below. `elastic` as above.
template <int D>
PistonOutcome<D> piston_outcome(const Model<D>& model, double side, double velocity,
                                const Arrival<D>& arrival, bool elastic);

}  // namespace clatter
