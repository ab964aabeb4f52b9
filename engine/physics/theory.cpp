#include "engine/physics/theory.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace clatter {

using std::numbers::pi;

// Volume of a particle of unit diameter.
static double particle_volume(int dimension) {
  return dimension == 2 ? pi / 4.0 : pi / 6.0;
}

double packing_fraction(int dimension, double density) {
  return particle_volume(dimension) * density;
}

double closest_packing(int dimension) {
  return dimension == 2 ? 0.5 * std::numbers::pi * std::numbers::inv_sqrt3
                        : std::numbers::pi / (3.0 * std::numbers::sqrt2);
}

double contact_correlation(double packing_fraction, int dimension) {
  const double empty = 1.0 - packing_fraction;
  if (dimension == 2) return (1.0 - 7.0 * packing_fraction / 16.0) / (empty * empty);
  return (1.0 - 0.5 * packing_fraction) / (empty * empty * empty);
}

double enskog_rate(double packing_fraction, double temperature, int dimension) {
  const double density = packing_fraction / particle_volume(dimension);
  return 2.0 * (dimension - 1) * std::sqrt(pi * temperature) *
         contact_correlation(packing_fraction, dimension) * density;
}

double compressibility(double packing_fraction, double restitution, int dimension) {
  return 1.0 + (dimension - 1) * (1.0 + restitution) * packing_fraction *
                   contact_correlation(packing_fraction, dimension);
}

double VibratedGas::packing_fraction() const {
  return clatter::packing_fraction(dimension, count / (length * wall_size));
}

double VibratedGas::psi() const {
  return (dimension - 1) * std::sqrt(2.0) * contact_correlation(packing_fraction(), dimension) *
         count / wall_size;
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

// (theory 7.11), with `loss` in place of eps_eff psi.
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
  return compressibility(packing_fraction(), 1.0, dimension) * length / (length - 1.0);
}

double VibratedGas::wall_hit_rate(double temperature) const {
  return count / length * std::sqrt(temperature / (2.0 * pi));
}

double VibratedGas::collision_rate(double temperature) const {
  return (dimension - 1) * std::sqrt(pi) * contact_correlation(packing_fraction(), dimension) *
         (count * (count - 1.0) / (length * wall_size)) * std::sqrt(temperature);
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
  return 2.0 / dimension * std::sqrt(temperature / (2.0 * pi)) / length *
         (drive_speed * drive_speed +
          2.0 * wall_restitution * drive_speed * std::sqrt(2.0 * temperature / pi) -
          pi / 2.0 * epsilon_effective() * psi() * temperature);
}

double VibratedGas::temperature_change_refined(double temperature) const {
  return 2.0 / dimension * std::sqrt(temperature / (2.0 * pi)) / length *
         (drive_speed * drive_speed +
          wall_restitution * drive_speed * std::sqrt(2.0 * pi * temperature) -
          pi * epsilon_effective() * psi() * temperature);
}

double VibratedGas::haff_rate_simple(double initial_temperature) const {
  return epsilon_effective() * psi() / (2.0 * dimension * length) *
         std::sqrt(pi * initial_temperature / 2.0);
}

double VibratedGas::haff_rate_refined(double initial_temperature) const {
  return 2.0 * haff_rate_simple(initial_temperature);
}

double VibratedGas::haff_rate_corrected(double initial_temperature) const {
  const double at_disks = (1.0 - restitution * restitution) * psi();
  const double at_walls = (2.0 / pi) * (1.0 - wall_restitution * wall_restitution);
  return std::sqrt(pi * initial_temperature / 2.0) / (dimension * length) *
         (at_disks + wall_layer_factor() * at_walls);
}

double RoughGas::eta() const {
  return inertia * (1.0 + tangential_restitution) / (2.0 * (1.0 + inertia));
}

double RoughGas::translational_loss() const {
  return (1.0 - restitution * restitution) / (2.0 * (dimension - 1)) + eta() * (1.0 - eta());
}

double RoughGas::exchange() const {
  return eta() * eta() / inertia;
}

double RoughGas::rotational_loss() const {
  return eta() / inertia * (1.0 - eta() / inertia);
}

double RoughGas::cooling_ratio() const {
  const double A = translational_loss(), B = exchange();
  // Translational over rotational degrees of freedom.
  const double ratio = 2.0 / (dimension - 1);
  const double difference = A - ratio * rotational_loss();
  return (difference + std::sqrt(difference * difference + 4.0 * ratio * B * B)) / (2.0 * B);
}

double RoughGas::driven_ratio() const {
  return eta() / (1.0 - eta() / inertia);
}

double RoughGas::driven_temperature(double packing_fraction, double power) const {
  // B^2/C is calculated as B times R = B/C, because R exists for smooth particles too.
  const double loss = translational_loss() - exchange() * driven_ratio();
  const double rate = enskog_rate(packing_fraction, 1.0, dimension);
  return std::pow(power / ((dimension - 1) * rate * loss), 2.0 / 3.0);
}

double haff_temperature(double initial_temperature, double rate, double time) {
  return initial_temperature / ((1.0 + rate * time) * (1.0 + rate * time));
}

double haff_rate_periodic(double packing_fraction, double restitution, double initial_temperature,
                          int dimension) {
  return (1.0 - restitution * restitution) *
         enskog_rate(packing_fraction, initial_temperature, dimension) / (2.0 * dimension);
}

double divergence_time(double rate) {
  return rate < 0.0 ? -1.0 / rate : std::numeric_limits<double>::infinity();
}

double bulk_drive_power(double count, double kick_speed, double interval, int dimension) {
  return 0.5 * dimension * kick_speed * kick_speed * (1.0 - 1.0 / count) / interval;
}

}  // namespace clatter
