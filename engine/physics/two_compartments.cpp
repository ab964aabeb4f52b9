#include "engine/physics/two_compartments.h"

#include <cmath>
#include <numbers>

namespace clatter {

// The thermal speed over v_dr follows from the powers of floor and collisions: a quadratic
// equation.
double TwoCompartments::flux(double filling) const {
  constexpr double kPi = std::numbers::pi;
  const double a =
      std::numbers::sqrt2 * kPi * filling + 2.0 * (1.0 - floor_restitution * floor_restitution);
  const double b = floor_restitution * std::sqrt(2.0 * kPi);
  const double speed = (b + std::sqrt(b * b + 4.0 * a)) / (2.0 * a);
  const double climb = gravity * height / (drive_speed * drive_speed);
  return filling / speed * std::exp(-climb / (speed * speed));
}

double TwoCompartments::fuller_share() const {
  const double all = (1.0 - restitution * restitution) * count / width;
  // Flux from the emptier compartment minus that from the fuller one.
  const auto excess = [&](double emptier) { return flux(emptier) - flux(all - emptier); };
  constexpr double kSmall = 1e-3;  // of the middle
  double low = 0.0, high = 0.5 * all * (1.0 - kSmall);
  if (!(excess(high) > 0.0)) return 0.5;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return 1.0 - low / all;
    (excess(middle) > 0.0 ? high : low) = middle;
  }
}

}  // namespace clatter
