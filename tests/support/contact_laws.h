#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/physics/collision.h"
#include "engine/physics/random.h"
#include "tests/support/dimensions.h"

namespace clatter::testing {

template <class Vector>
Vector random_vector(Random& random) {
  Vector v;
  for (double& component : v) component = random.normal();
  return v;
}

/// Random contact laws: elastic or inelastic, smooth, rough or perfectly rough. Friction is zero,
/// finite (from very small to larger than any slip needs) or infinite.
inline ContactLaw random_law(Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ContactLaw law;
  law.restitution = random.below(3) == 0 ? 1.0 : random.uniform();
  const double finite = std::pow(10.0, 4.0 * random.uniform() - 3.0);
  law.friction = std::array{0.0, kInfinity, finite, finite}[random.below(4)];
  const double between = 2.0 * random.uniform() - 1.0;
  law.tangential_restitution = std::array{-1.0, 1.0, between, between}[random.below(4)];
  return law;
}

/// Whether contacts under this law conserve the energy of slip and spins: without friction, or with
/// enough friction to reverse the slip.
inline bool keeps_spin_and_slip_energy(const ContactLaw& law) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double beta_0 = law.tangential_restitution;
  return law.friction == 0.0 || beta_0 == -1.0 || (law.friction == kInfinity && beta_0 == 1.0);
}

/// Inertia of a uniform disk, of a uniform sphere, or a random value.
inline double random_inertia(Random& random) {
  return std::array{0.5, 0.4, 0.01 + random.uniform()}[random.below(3)];
}

/// A particle of random size, mass and inertia.
inline Grain random_grain(Random& random) {
  return {.radius = 0.25 + 0.5 * random.uniform(),
          .mass = std::pow(10.0, 4.0 * random.uniform() - 2.0),
          .inertia = random_inertia(random)};
}

/// The tangential impulse directly from the contact laws, without the formulas of beta and eta. It
/// changes the slip to -beta_0 times its value, limited by Coulomb's law. `per_impulse` is the
/// change of the slip by a tangential impulse of 1: the sum over the particles of (1/m) (1 + 1/q).
template <int D>
Vec<D> friction_by_law(const Vec<D>& n, const Vec<D>& surface_velocity, double normal_impulse,
                       const ContactLaw& law, double per_impulse) {
  const Vec<D> slip = surface_velocity - n.dot(surface_velocity) * n;
  const double reversing = (1.0 + law.tangential_restitution) * slip.norm() / per_impulse;
  return -std::min(reversing, law.friction * normal_impulse) * slip.normalized();
}

}  // namespace clatter::testing
