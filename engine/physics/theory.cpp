#include "engine/physics/theory.h"

#include <cmath>
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
  const double alpha_w = wall_restitution;
  const double s = std::pow(2.0 / pi, 1.5) *
                   (alpha_w + std::sqrt(alpha_w * alpha_w + pi * pi / 4.0 * loss)) / loss;
  return s * s * drive_speed * drive_speed;
}

double VibratedGas::temperature_refined() const {
  const double loss = epsilon_effective() * psi();
  const double alpha_w = wall_restitution;
  const double s =
      (alpha_w + std::sqrt(alpha_w * alpha_w + 2.0 * loss)) / (std::sqrt(2.0 * pi) * loss);
  return s * s * drive_speed * drive_speed;
}

}  // namespace clatter
