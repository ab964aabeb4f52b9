#pragma once

#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// x.x for spheres of diameter a at contact, where it is about a^2. Doubles are twice as dense
/// below a^2 = 1 as above, so the plain sum would on average be too small, and an elastic gas of
/// 100 spheres would gain 1e-19 of its energy per collision. The sum therefore ends at 1.5 a^2.
/// Disks have the plain sum, so that their runs keep the bits of earlier versions.
template <int D>
double contact_square(const Vec<D>& x, double diameter) {
  if constexpr (D == 2) return x.squaredNorm();
  const double half = 0.5 * diameter * diameter;
  double sum = half;
  for (const double component : x) sum += component * component;
  return sum - half;
}

/// Momentum that particle 1 gains in a collision of smooth particles (theory 3.2) with beta = -1:
/// -(1 + alpha)/2 (n.g) n, for x = r_1 - r_2 at contact, g = v_1 - v_2 and diameter a; particle 2
/// gains its negative. The division by x.x instead of a^2 keeps elastic collisions elastic to
/// rounding, for any rounding of x.
template <int D>
Vec<D> collision_impulse(const Vec<D>& x, const Vec<D>& g, double restitution, double diameter) {
  return x * (-0.5 * (1.0 + restitution) * x.dot(g) / contact_square<D>(x, diameter));
}

/// Energy that a collision of smooth particles loses, (m/4) (1 - alpha^2) g_n^2 (theory 3.6); x and
/// g as in collision_impulse.
template <int D>
double dissipated_energy(const Vec<D>& x, const Vec<D>& g, double restitution) {
  const double approach = x.dot(g);
  return 0.25 * (1.0 - restitution * restitution) * approach * approach / x.squaredNorm();
}

/// Contact law of two surfaces, Walton's model (theory 3).
struct ContactLaw {
  double restitution = 1.0;              ///< alpha, of the normal velocity
  double friction = 0.0;                 ///< mu >= 0, Coulomb's; may be infinite
  double tangential_restitution = -1.0;  ///< beta_0, -1 (smooth) .. 1 (perfectly rough)

  /// Whether a contact can change a spin.
  bool rough() const { return friction > 0.0 && tangential_restitution > -1.0; }
};

/// Gain of a particle in a contact.
template <int D>
struct Impulse {
  Vec<D> momentum = Vec<D>::Zero();  ///< of a particle of mass 1; its partner gains the negative
  Spin<D> spin = Spin<D>::Zero();    ///< angular velocity; a partner particle gains the same
};

/// 1 + beta with the beta in force (theory 3.5): min(1 + beta_0, mu ((1+q)/q) |g_n' - g_n|/|g_t|),
/// where `normal_change` = |g_n' - g_n| is (1 + alpha)|g_n| of two particles and |v_n' - v_n| of a
/// particle at a wall, and `slip` = |g_t|. The result is 1 + beta, because beta near -1 would lose
/// digits.
inline double slip_reversal(const ContactLaw& law, double inertia, double normal_change,
                            double slip) {
  const double full = 1.0 + law.tangential_restitution;
  const double coulomb = law.friction * (1.0 + inertia) * normal_change;
  // The comparison comes before the division, because the slip may be 0. Infinite friction gives
  // `full` even without normal force, when coulomb is NaN.
  return coulomb < full * inertia * slip ? coulomb / (inertia * slip) : full;
}

/// g_t, the tangential velocity of the touching surfaces (theory 3.1); n is the unit vector from
/// the partner, `v` the relative velocity of the centres and `spin` the sum of the angular
/// velocities.
template <int D>
Vec<D> surface_slip(const Vec<D>& n, const Vec<D>& v, const Spin<D>& spin, double diameter) {
  const Vec<D> g = v + 0.5 * diameter * cross_spin<D>(n, spin);
  return g - n.dot(g) * n;
}

/// Gain of particle 1 of two by friction (theory 3.2, 3.3): the momentum -eta g_t and the spin (2
/// eta/(q a)) n x g_t with eta = q (1 + beta)/(2 (1 + q)). A wall, of infinite mass, gives twice
/// these values. Arguments as in surface_slip and slip_reversal.
template <int D>
Impulse<D> friction_impulse(const Vec<D>& n, const Vec<D>& v, const Spin<D>& spin,
                            double normal_change, const ContactLaw& law, double inertia,
                            double diameter) {
  const Vec<D> g_t = surface_slip<D>(n, v, spin, diameter);
  // 2 eta/q, which exists at q = 0 too.
  const double share = slip_reversal(law, inertia, normal_change, g_t.norm()) / (1.0 + inertia);
  return {-0.5 * inertia * share * g_t, share / diameter * cross<D>(n, g_t)};
}

/// Gain of particle 1 in a collision of rough particles (theory 3.2, 3.3), for x = r_1 - r_2 at
/// contact, v = v_1 - v_2, spin = omega_1 + omega_2, inertia q = 4I/(m a^2) and diameter a. The
/// normal part has the bits of collision_impulse. A law that is not rough has no other part.
template <int D>
Impulse<D> rough_impulse(const Vec<D>& x, const Vec<D>& v, const Spin<D>& spin,
                         const ContactLaw& law, double inertia, double diameter) {
  const Vec<D> normal = collision_impulse<D>(x, v, law.restitution, diameter);
  if (!law.rough()) return {normal};
  const Impulse<D> friction =
      friction_impulse<D>(x / x.norm(), v, spin, 2.0 * normal.norm(), law, inertia, diameter);
  return {normal + friction.momentum, friction.spin};
}

/// Energy that a collision of rough particles loses, (m/4) [(1 - alpha^2) g_n^2 + (q/(1+q)) (1 -
/// beta^2) g_t^2] (theory 3.6), with the beta in force; arguments as in rough_impulse.
template <int D>
double dissipated_energy(const Vec<D>& x, const Vec<D>& v, const Spin<D>& spin,
                         const ContactLaw& law, double inertia, double diameter) {
  const double normal_loss = dissipated_energy<D>(x, v, law.restitution);
  if (!law.rough()) return normal_loss;
  const double normal_change = 2.0 * collision_impulse<D>(x, v, law.restitution, diameter).norm();
  const double slip = surface_slip<D>(x / x.norm(), v, spin, diameter).norm();
  const double reversal = slip_reversal(law, inertia, normal_change, slip);
  // (1 - beta^2) = (1 + beta) (1 - beta)
  const double share = reversal * (2.0 - reversal) * inertia / (1.0 + inertia);
  return normal_loss + 0.25 * share * slip * slip;
}

}  // namespace clatter
