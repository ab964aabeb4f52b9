#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "engine/physics/shear_theory.h"
#include "engine/physics/theory.h"

namespace clatter::shear_theory {

// Numbers of Grad's solution, computed with another program to three digits.
TEST_CASE("Shear theory: Grad's solution has the temperatures and stresses of another program") {
  const ShearTheory disks = grad_shear(0.02, 0.8, 2.0, 2);
  CHECK(disks.temperature / 4.0 == doctest::Approx(511.0).epsilon(1e-3));
  CHECK(disks.stress_xx == doctest::Approx(1.174).epsilon(1e-3));
  CHECK(disks.stress_yy == doctest::Approx(0.826).epsilon(1e-3));
  CHECK(disks.stress_yx == doctest::Approx(-0.379).epsilon(2e-3));
  const ShearTheory spheres = grad_shear(0.01, 0.8, -1.0, 3);
  CHECK(spheres.temperature == doctest::Approx(309.0).epsilon(2e-3));
  CHECK(spheres.stress_xx == doctest::Approx(1.303).epsilon(1e-3));
  CHECK(spheres.stress_yy == doctest::Approx(0.848).epsilon(1e-3));
  CHECK(spheres.stress_yx == doctest::Approx(0.439).epsilon(2e-3));
}

// Disks of phi = 0.3: chi = (1 - 7 phi/16)/(1 - phi)^2 = 1.77296, the bracket is 1/chi + 0.6
// + 3.54648 0.09 chi = 1.72994, so eta = 0.511/sqrt(pi) 1.72994 = 0.49875 at T = 1.
TEST_CASE("Shear theory: Enskog's viscosity by hand, and the balance of power and loss") {
  CHECK(enskog_viscosity(0.3, 1.0, 2) == doctest::Approx(0.49875).epsilon(1e-4));
  CHECK(enskog_viscosity(0.3, 4.0, 3) == doctest::Approx(2.0 * enskog_viscosity(0.3, 1.0, 3)));
  for (const int dimension : {2, 3}) {
    const double rate = 0.7, alpha = 0.95, phi = 0.3;
    const double temperature = enskog_shear_temperature(phi, alpha, rate, dimension);
    const double density = phi / packing_fraction(dimension, 1.0);
    const double loss = 0.5 * density * (1.0 - alpha * alpha) *
                        enskog_rate(phi, temperature, dimension) * temperature;
    CHECK(enskog_viscosity(phi, temperature, dimension) * rate * rate == doctest::Approx(loss));
  }
}

}  // namespace clatter::shear_theory
