#pragma once

#include <array>

#include "engine/physics/grain.h"
#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// What determines the collisions of two particles, beside their contact law (theory 12.1).
struct Partners {
  double distance = 1.0;                     ///< of the centres at contact, the sum of the radii
  double mass = 0.5;                         ///< reduced mass m_12
  double inertia = 0.5;                      ///< 1/k, the q of partners with the same q
  std::array<double, 2> turns = {1.0, 1.0};  ///< (d_i/2I_i) m_12/k of each partner

  Partners() = default;
  Partners(const Grain& first, const Grain& second)
      : distance(first.radius + second.radius),
        mass(first.mass * second.mass / (first.mass + second.mass)) {
    const double q_1 = first.inertia, q_2 = second.inertia;
    const double m_1 = first.mass, m_2 = second.mass;
    // (1/k)/q_i, which is 1 also if both q are 0.
    std::array<double, 2> shares = {1.0, 1.0};
    inertia = q_1;
    if (q_1 != q_2) {
      const double sum = m_1 * q_1 + m_2 * q_2;
      shares = {(m_1 + m_2) * q_2 / sum, (m_1 + m_2) * q_1 / sum};
      inertia = (m_1 + m_2) * (q_1 * q_2) / sum;
    }
    turns = {mass * shares[0] / (m_1 * first.radius), mass * shares[1] / (m_2 * second.radius)};
  }
};

/// x.x of two spheres whose centres are at the distance s at contact, where it is about s^2.
/// Doubles are twice as dense below s^2 = 1 as above, so the plain sum would on average be too
/// small, and an elastic gas of 100 spheres would gain 1e-19 of its energy per collision. The sum
/// therefore ends at 1.5 s^2. Disks have the plain sum, so that their runs keep the bits of earlier
/// versions.
template <int D>
double contact_square(const Vec<D>& x, double distance) {
  if constexpr (D == 2) return x.squaredNorm();
  const double half = 0.5 * distance * distance;
  double sum = half;
  for (const double component : x) sum += component * component;
  return sum - half;
}

/// Momentum that particle 1 gains in a collision of smooth particles, -(1 + alpha) m_12 (n.g) n,
/// for x = r_1 - r_2 at contact and g = v_1 - v_2; particle 2 gains its negative. The division by
/// x.x instead of the square of the distance keeps elastic collisions elastic to rounding, for any
/// rounding of x.
template <int D>
Vec<D> collision_impulse(const Vec<D>& x, const Vec<D>& g, double restitution,
                         const Partners& partners) {
  return x * (-partners.mass * (1.0 + restitution) * x.dot(g) /
              contact_square<D>(x, partners.distance));
}

/// Energy that a collision of smooth particles loses, (m_12/2) (1 - alpha^2) g_n^2; x and g as in
/// collision_impulse.
template <int D>
double dissipated_energy(const Vec<D>& x, const Vec<D>& g, double restitution,
                         const Partners& partners) {
  const double approach = x.dot(g);
  return 0.5 * partners.mass * (1.0 - restitution * restitution) * approach * approach /
         x.squaredNorm();
}

/// Contact law of two surfaces, Walton's model (theory 3).
struct ContactLaw {
  double restitution = 1.0;              ///< alpha, of the normal velocity
  double friction = 0.0;                 ///< mu >= 0, Coulomb's; may be infinite
  double tangential_restitution = -1.0;  ///< beta_0, -1 (smooth) .. 1 (perfectly rough)

  /// Whether a contact can change a spin.
  bool rough() const { return friction > 0.0 && tangential_restitution > -1.0; }
};

/// Gain of a particle in an event.
template <int D>
struct Impulse {
  Vec<D> momentum = Vec<D>::Zero();
  Spin<D> spin = Spin<D>::Zero();  ///< angular velocity
};

/// Gains of two particles in a collision.
template <int D>
struct Exchange {
  Vec<D> momentum = Vec<D>::Zero();  ///< of the first; the second gains the negative
  std::array<Spin<D>, 2> spins = {Spin<D>::Zero(), Spin<D>::Zero()};  ///< of each

  /// Gain of the first or second particle.
  Impulse<D> of(int partner) const {
    return {partner == 0 ? momentum : Vec<D>(-momentum), spins[static_cast<std::size_t>(partner)]};
  }
};

/// 1 + beta with the beta in force: min(1 + beta_0, mu ((1+q)/q) |g_n' - g_n|/|g_t|), where q is
/// Partners::inertia or that of a particle at a wall. `normal_change` = |g_n' - g_n| is (1 +
/// alpha)|g_n| of two particles and |v_n' - v_n| of a particle at a wall, and `slip` = |g_t|. The
/// result is 1 + beta, because beta near -1 would lose digits (theory 3.5).
inline double slip_reversal(const ContactLaw& law, double inertia, double normal_change,
                            double slip) {
  const double full = 1.0 + law.tangential_restitution;
  const double coulomb = law.friction * (1.0 + inertia) * normal_change;
  // The comparison comes before the division, because the slip may be 0. Infinite friction gives
  // `full` even without normal force, when coulomb is NaN.
  return coulomb < full * inertia * slip ? coulomb / (inertia * slip) : full;
}

/// g_t, the tangential velocity of the touching surfaces (theory 3.1); n is the unit vector from
/// the partner, `v` the relative velocity of the centres and `surface` the sum of radius times
/// angular velocity.
template <int D>
Vec<D> surface_slip(const Vec<D>& n, const Vec<D>& v, const Spin<D>& surface) {
  const Vec<D> g = v + cross_spin<D>(n, surface);
  return g - n.dot(g) * n;
}

/// Action of friction in a contact. Its momentum is -m_12 q share g_t, its turn of a partner
/// Partners::turns times share n x g_t.
template <int D>
struct Friction {
  Vec<D> slip;   ///< g_t
  double share;  ///< (1 + beta)/(1 + q)
};

/// Friction between two surfaces; arguments as in surface_slip and slip_reversal.
template <int D>
Friction<D> friction_of(const Vec<D>& n, const Vec<D>& v, const Spin<D>& surface,
                        double normal_change, const ContactLaw& law, double inertia) {
  const Vec<D> slip = surface_slip<D>(n, v, surface);
  return {slip, slip_reversal(law, inertia, normal_change, slip.norm()) / (1.0 + inertia)};
}

/// Gains in a collision of rough particles (theory 3.2, 3.3, 12.3), for x = r_1 - r_2 at
/// contact and v = v_1 - v_2. `surface` is the sum of radius times angular velocity. The normal
/// part has the bits of collision_impulse. A law that is not rough has no other part.
template <int D>
Exchange<D> rough_impulse(const Vec<D>& x, const Vec<D>& v, const Spin<D>& surface,
                          const ContactLaw& law, const Partners& partners) {
  const Vec<D> normal = collision_impulse<D>(x, v, law.restitution, partners);
  if (!law.rough()) return {normal};
  const Vec<D> n = x / x.norm();
  const auto [slip, share] =
      friction_of<D>(n, v, surface, normal.norm() / partners.mass, law, partners.inertia);
  const Spin<D> turn = cross<D>(n, slip);
  return {normal - partners.mass * partners.inertia * share * slip,
          {share * partners.turns[0] * turn, share * partners.turns[1] * turn}};
}

/// Energy that a collision of rough particles loses, (m_12/2) [(1 - alpha^2) g_n^2 + (q/(1+q)) (1 -
/// beta^2) g_t^2] with q = 1/k and the beta in force (theory 3.6, 12.4); arguments as in
/// rough_impulse.
template <int D>
double dissipated_energy(const Vec<D>& x, const Vec<D>& v, const Spin<D>& surface,
                         const ContactLaw& law, const Partners& partners) {
  const double normal_loss = dissipated_energy<D>(x, v, law.restitution, partners);
  if (!law.rough()) return normal_loss;
  const double normal_change =
      collision_impulse<D>(x, v, law.restitution, partners).norm() / partners.mass;
  const double slip = surface_slip<D>(x / x.norm(), v, surface).norm();
  const double q = partners.inertia;
  const double reversal = slip_reversal(law, q, normal_change, slip);
  // (1 - beta^2) = (1 + beta) (1 - beta)
  const double share = reversal * (2.0 - reversal) * q / (1.0 + q);
  return normal_loss + 0.5 * partners.mass * share * slip * slip;
}

}  // namespace clatter
