#include "engine/physics/theory.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace clatter {

using std::numbers::pi;

double contact_correlation(double area_fraction) {
  const double empty = 1.0 - area_fraction;
  return (1.0 - 7.0 * area_fraction / 16.0) / (empty * empty);
}

double enskog_rate(double area_fraction, double temperature) {
  const double density = 4.0 * area_fraction / pi;
  return 2.0 * std::sqrt(pi * temperature) * contact_correlation(area_fraction) * density;
}

double compressibility(double area_fraction, double restitution) {
  return 1.0 + (1.0 + restitution) * area_fraction * contact_correlation(area_fraction);
}

double VibratedGas::area_fraction() const {
  return count * pi / (4.0 * length * width);
}

double VibratedGas::psi() const {
  return std::sqrt(2.0) * contact_correlation(area_fraction()) * count / width;
}

double VibratedGas::epsilon_effective() const {
  return (1.0 - restitution * restitution) +
         (2.0 / pi) * (1.0 - wall_restitution * wall_restitution) / psi();
}

double VibratedGas::temperature_simple() const {
  const double loss = epsilon_effective() * psi();
  if (!(loss > 0.0)) return std::numeric_limits<double>::infinity();
  const double alpha_w = wall_restitution;
  const double s = std::pow(2.0 / pi, 1.5) *
                   (alpha_w + std::sqrt(alpha_w * alpha_w + pi * pi / 4.0 * loss)) / loss;
  return s * s * drive_speed * drive_speed;
}

// Eq. (3.14); `loss` stands for eps_eff psi.
static double stationary_refined(double loss, double wall_restitution, double drive_speed) {
  if (!(loss > 0.0)) return std::numeric_limits<double>::infinity();
  const double alpha_w = wall_restitution;
  const double s =
      (alpha_w + std::sqrt(alpha_w * alpha_w + 2.0 * loss)) / (std::sqrt(2.0 * pi) * loss);
  return s * s * drive_speed * drive_speed;
}

double VibratedGas::temperature_refined() const {
  return stationary_refined(epsilon_effective() * psi(), wall_restitution, drive_speed);
}

double VibratedGas::temperature_corrected() const {
  const double at_disks = (1.0 - restitution * restitution) * psi() / wall_layer_factor();
  const double at_walls = (2.0 / pi) * (1.0 - wall_restitution * wall_restitution);
  return stationary_refined(at_disks + at_walls, wall_restitution, drive_speed);
}

double VibratedGas::wall_layer_factor() const {
  return compressibility(area_fraction(), 1.0) * length / (length - 1.0);
}

double VibratedGas::wall_hit_rate(double temperature) const {
  return count / length * std::sqrt(temperature / (2.0 * pi));
}

double VibratedGas::collision_rate(double temperature) const {
  return std::sqrt(pi) * contact_correlation(area_fraction()) *
         (count * (count - 1.0) / (length * width)) * std::sqrt(temperature);
}

double VibratedGas::energy_per_wall_hit(double temperature) const {
  const double alpha_w = wall_restitution;
  return 0.5 * (drive_speed * drive_speed +
                4.0 * alpha_w * std::sqrt(temperature / (2.0 * pi)) * drive_speed -
                (1.0 - alpha_w * alpha_w) * temperature);
}

double VibratedGas::energy_per_collision(double temperature) const {
  return -(1.0 - restitution * restitution) * temperature / 2.0;
}

double VibratedGas::temperature_change_simple(double temperature) const {
  return std::sqrt(temperature / (2.0 * pi)) / length *
         (drive_speed * drive_speed +
          2.0 * wall_restitution * drive_speed * std::sqrt(2.0 * temperature / pi) -
          pi / 2.0 * epsilon_effective() * psi() * temperature);
}

double VibratedGas::temperature_change_refined(double temperature) const {
  return std::sqrt(temperature / (2.0 * pi)) / length *
         (drive_speed * drive_speed +
          wall_restitution * drive_speed * std::sqrt(2.0 * pi * temperature) -
          pi * epsilon_effective() * psi() * temperature);
}

double VibratedGas::haff_rate_simple(double initial_temperature) const {
  return epsilon_effective() * psi() / (4.0 * length) * std::sqrt(pi * initial_temperature / 2.0);
}

double VibratedGas::haff_rate_refined(double initial_temperature) const {
  return 2.0 * haff_rate_simple(initial_temperature);
}

double VibratedGas::haff_rate_corrected(double initial_temperature) const {
  const double at_disks = (1.0 - restitution * restitution) * psi();
  const double at_walls = (2.0 / pi) * (1.0 - wall_restitution * wall_restitution);
  return std::sqrt(pi * initial_temperature / 2.0) / (2.0 * length) *
         (at_disks + wall_layer_factor() * at_walls);
}

double RoughGas::eta() const {
  return inertia * (1.0 + tangential_restitution) / (2.0 * (1.0 + inertia));
}

double RoughGas::translational_loss() const {
  return (1.0 - restitution * restitution) / 2.0 + eta() * (1.0 - eta());
}

double RoughGas::exchange() const {
  return eta() * eta() / inertia;
}

double RoughGas::rotational_loss() const {
  return eta() / inertia * (1.0 - eta() / inertia);
}

double RoughGas::cooling_ratio() const {
  const double A = translational_loss(), B = exchange(), C = rotational_loss();
  return ((A - 2.0 * C) + std::sqrt((A - 2.0 * C) * (A - 2.0 * C) + 8.0 * B * B)) / (2.0 * B);
}

double RoughGas::driven_ratio() const {
  return eta() / (1.0 - eta() / inertia);
}

double RoughGas::driven_temperature(double area_fraction, double power) const {
  // B^2/C is B times the ratio R = B/C, which smooth disks have too.
  const double A = translational_loss(), B = exchange();
  return std::pow(power / (enskog_rate(area_fraction, 1.0) * (A - B * driven_ratio())), 2.0 / 3.0);
}

double haff_temperature(double initial_temperature, double rate, double time) {
  return initial_temperature / ((1.0 + rate * time) * (1.0 + rate * time));
}

double haff_rate_periodic(double area_fraction, double restitution, double initial_temperature) {
  return (1.0 - restitution * restitution) * enskog_rate(area_fraction, initial_temperature) / 4.0;
}

double divergence_time(double rate) {
  return rate < 0.0 ? -1.0 / rate : std::numeric_limits<double>::infinity();
}

double bulk_drive_power(double count, double kick_speed, double interval) {
  return kick_speed * kick_speed * (1.0 - 1.0 / count) / interval;
}

}  // namespace clatter
