#include "engine/physics/shear_theory.h"

#include <cmath>
#include <numbers>

#include "engine/physics/theory.h"

namespace clatter {

static double density_of(double packing_fraction, int dimension) {
  return packing_fraction / clatter::packing_fraction(dimension, 1.0);
}

ShearTheory grad_shear(double packing_fraction, double restitution, double rate, int dimension) {
  const double d = dimension, alpha = restitution;
  const double b = 0.5 * (1.0 + alpha) * (1.0 - (d - 1.0) * (1.0 - alpha) / (2.0 * d));
  const double z = (d + 2.0) * (1.0 - alpha * alpha) / (4.0 * d);
  const double reduced = std::sqrt(d * z / (2.0 * b)) * (b + z);  // rate over the frequency
  // The frequency at T = 1.
  const double frequency = 8.0 / (d + 2.0) * std::pow(std::numbers::pi, 0.5 * (d - 1.0)) /
                           std::tgamma(0.5 * d) * density_of(packing_fraction, dimension) *
                           contact_correlation(packing_fraction, dimension);
  ShearTheory gas;
  gas.temperature = std::pow(rate / (reduced * frequency), 2);
  gas.stress_yy = b / (b + z);
  gas.stress_xx = d - (d - 1.0) * gas.stress_yy;
  gas.stress_yx = -std::copysign(reduced, rate) * b / ((b + z) * (b + z));
  return gas;
}

double enskog_viscosity(double packing_fraction, double temperature, int dimension) {
  constexpr double pi = std::numbers::pi;
  const double phi = packing_fraction, chi = contact_correlation(phi, dimension);
  const double unit = std::sqrt(temperature / pi);
  if (dimension == 2) {
    return 0.511 * unit * (1.0 / chi + 2.0 * phi + (1.0 + 8.0 / pi) * phi * phi * chi);
  }
  const double pairs = 1.0 + 1.6 * phi * chi;
  return 0.3175 * unit * (pairs * pairs / chi + 768.0 / (25.0 * pi) * phi * phi * chi);
}

double enskog_shear_temperature(double packing_fraction, double restitution, double rate,
                                int dimension) {
  const double loss = 0.5 * density_of(packing_fraction, dimension) *
                      (1.0 - restitution * restitution) *
                      enskog_rate(packing_fraction, 1.0, dimension);
  return enskog_viscosity(packing_fraction, 1.0, dimension) * rate * rate / loss;
}

}  // namespace clatter
