#pragma once

#include <array>
#include <cmath>

#include "engine/physics/collision.h"
#include "engine/physics/elementary.h"
#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// A velocity with another component along a unit vector. For a coordinate axis it is exact.
template <int D>
Vec<D> with_normal(const Vec<D>& v, const Vec<D>& normal, double component) {
  return (v - v.dot(normal) * normal) + component * normal;
}

/// Velocity after a static or driven wall (theory 4.1): v_n' = alpha_w |v_n| + v_dr along `normal`,
/// the wall's unit vector towards the gas. Both velocities are relative to the wall, which moves at
/// `wall_velocity` along the normal. The other components stay.
template <int D>
Vec<D> reflect(const Vec<D>& v, const Vec<D>& normal, double restitution, double drive_speed,
               double wall_velocity = 0.0) {
  const double approach = std::fabs(v.dot(normal) - wall_velocity);
  return with_normal<D>(v, normal, restitution * approach + drive_speed + wall_velocity);
}

/// Velocity after a wall that moves (theory 4.2): v_n' = -alpha_w v_n + (1 + alpha_w) u, the
/// reflection in the wall's frame, where u = `wall_velocity` along the normal into the box. A wall
/// that overtakes a particle (0 < v_n < u) hits it from behind.
template <int D>
Vec<D> reflect_moving(const Vec<D>& v, const Vec<D>& normal, double restitution,
                      double wall_velocity) {
  return with_normal<D>(v, normal,
                        (1.0 + restitution) * wall_velocity - restitution * v.dot(normal));
}

/// Change of a particle's motion at a wall.
template <int D>
struct MotionChange {
  Vec<D> velocity = Vec<D>::Zero();
  Spin<D> spin = Spin<D>::Zero();
};

/// Change of a particle's motion by friction at a wall (theory 4.5), whose mass is infinite: the
/// velocity -2 eta_w g_t and the spin (4 eta_w/(q a)) n x g_t, with g_t from the velocity and spin
/// before. `after` is the velocity after a smooth wall: Coulomb's bound uses the true normal
/// impulse |v_n' - v_n| of every kind of wall.
template <int D>
MotionChange<D> wall_friction(const Vec<D>& before, const Vec<D>& after, const Spin<D>& spin,
                              const Vec<D>& n, const ContactLaw& law, const Grain& grain) {
  if (!law.rough()) return {};
  const double normal_change = std::fabs(after.dot(n) - before.dot(n));
  const Spin<D> surface = grain.radius * spin;
  const auto [slip, share] = friction_of<D>(n, before, surface, normal_change, law, grain.inertia);
  return {-grain.inertia * share * slip, share / grain.radius * cross<D>(n, slip)};
}

/// Velocity after a thermal wall of temperature T_w (theory 4.7): the normal component has the
/// flux-weighted density (m v/T_w) exp(-m v^2/2T_w), v = sqrt(-2 (T_w/m) ln U), the others are
/// Gaussian of variance T_w/m. `variance` is T_w/m, `uniform` is in (0,1); `normals` holds D - 1
/// standard normal variates. They belong to the coordinate axes except the one nearest to the
/// normal, made orthogonal in order.
template <int D>
Vec<D> emit(const Vec<D>& normal, double variance, double uniform, const double* normals) {
  int nearest = 0;
  normal.cwiseAbs().maxCoeff(&nearest);
  std::array<Vec<D>, D> basis = {normal};
  Vec<D> v = std::sqrt(-2.0 * variance * natural_log(uniform)) * normal;
  int made = 1;
  for (int axis = 0; axis < D; ++axis) {
    if (axis == nearest) continue;
    Vec<D> tangent = Vec<D>::Unit(axis);
    for (int k = 0; k < made; ++k) tangent -= tangent.dot(basis[k]) * basis[k];
    basis[made++] = tangent /= tangent.norm();
    v += std::sqrt(variance) * *normals++ * tangent;
  }
  return v;
}

/// Spin after a thermal wall (theory 4): Gaussian of variance T_w/I per component.
/// `normals` holds one standard normal variate per component.
template <int D>
Spin<D> emit_spin(double temperature, const Grain& grain, const double* normals) {
  return std::sqrt(temperature / grain.moment_of_inertia()) * Eigen::Map<const Spin<D>>(normals);
}

}  // namespace clatter
