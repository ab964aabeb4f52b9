#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "engine/physics/theory.h"

using namespace clatter;
using std::numbers::pi;

namespace {

/// The gases of these tests: 20 x 25 diameters.
VibratedGas vibrated(double count, double restitution, double wall_restitution) {
  return {count, 20.0, 25.0, restitution, wall_restitution, 1.0};
}

/// The bracket of Eq. (3.7): what the walls give, less what is lost. It is zero where the gas is
/// stationary. Simple: averages over all disks. Refined: over those that collide, which doubles
/// both losses and multiplies the term linear in v_dr by pi/2.
double bracket(const VibratedGas& gas, double temperature, bool refined) {
  const double loss = 0.5 * pi * gas.epsilon_effective() * gas.psi() * temperature;
  const double gain =
      2.0 * gas.wall_restitution * gas.drive_speed * std::sqrt(2.0 * temperature / pi);
  const double constant = gas.drive_speed * gas.drive_speed;
  return refined ? constant + 0.5 * pi * gain - 2.0 * loss : constant + gain - loss;
}

}  // namespace

TEST_CASE("contact_correlation: Eq. (3.6)") {
  CHECK(contact_correlation(0.0) == 1.0);
  CHECK(contact_correlation(0.5) == doctest::Approx(3.125).epsilon(1e-15));       // (25/32) / (1/4)
  CHECK(contact_correlation(0.2) == doctest::Approx(1.42578125).epsilon(1e-14));  // .9125/.64
}

TEST_CASE("compressibility: section 5") {
  CHECK(compressibility(0.0, 1.0) == 1.0);
  CHECK(compressibility(0.5, 1.0) == doctest::Approx(4.125).epsilon(1e-15));  // 1 + 2 * .5 * 3.125
  // Each impulse is (1 + alpha)/2 of the elastic one.
  CHECK(compressibility(0.5, 0.6) == doctest::Approx(1.0 + 0.8 * 3.125).epsilon(1e-15));
  // Second virial coefficient of hard disks: pi a^2/2 per disk, so Z = 1 + 2 phi + ...
  CHECK((compressibility(1e-6, 1.0) - 1.0) / 1e-6 == doctest::Approx(2.0).epsilon(1e-5));
}

TEST_CASE("enskog_rate: Eq. (3.5)") {
  // chi(.1) = .95625/.81, rho = .4/pi: 2 sqrt(pi) * 1.1805556 * .1273240.
  CHECK(enskog_rate(0.1, 1.0) == doctest::Approx(0.5328457177951).epsilon(1e-12));
  CHECK(enskog_rate(0.1, 9.0) == doctest::Approx(3.0 * enskog_rate(0.1, 1.0)).epsilon(1e-14));
  CHECK(enskog_rate(0.1, 0.0) == 0.0);
  // Dilute: mean relative speed sqrt(pi T) times the cross-section 2a times rho.
  const double rho = 4.0 * 1e-6 / pi;
  CHECK(enskog_rate(1e-6, 2.0) == doctest::Approx(2.0 * rho * std::sqrt(2.0 * pi)).epsilon(1e-5));
}

TEST_CASE("VibratedGas: the parameters of Eqs. (3.8) and (3.9)") {
  const VibratedGas gas = vibrated(200.0, 0.9, 0.95);
  CHECK(gas.area_fraction() == doctest::Approx(pi / 10.0).epsilon(1e-15));
  // sqrt(2) * 1.8337511829 * 200/25
  CHECK(gas.psi() == doctest::Approx(20.746526342878).epsilon(1e-12));
  // .19 + (2/pi) * .0975/psi
  CHECK(gas.epsilon_effective() == doctest::Approx(0.192991846769).epsilon(1e-11));
  CHECK(vibrated(200.0, 0.9, 1.0).epsilon_effective() == doctest::Approx(0.19).epsilon(1e-14));
}

TEST_CASE("VibratedGas: the stationary temperatures make the brackets of Eq. (3.7) zero") {
  for (const double restitution : {0.5, 0.9, 0.99, 1.0}) {
    for (const double wall_restitution : {0.3, 0.9, 1.0}) {
      if (restitution == 1.0 && wall_restitution == 1.0) continue;
      for (const double count : {20.0, 100.0, 400.0}) {
        const VibratedGas gas = vibrated(count, restitution, wall_restitution);
        const double simple = gas.temperature_simple();
        const double refined = gas.temperature_refined();
        const double constant = 1.0;  // the bracket's smallest term, m v_dr^2
        CHECK(std::fabs(bracket(gas, simple, false)) < 1e-12 * (constant + simple));
        CHECK(std::fabs(bracket(gas, refined, true)) < 1e-12 * (constant + refined));
        // A zero from gain to loss: the stationary state is stable.
        CHECK(bracket(gas, 1.01 * refined, true) < 0.0);
        CHECK(bracket(gas, 0.99 * refined, true) > 0.0);
      }
    }
  }
}

TEST_CASE("VibratedGas: temperatures by bisection of Eq. (3.7)") {
  // Found outside of this program, by bisection of the two brackets.
  CHECK(vibrated(100.0, 0.9, 1.0).temperature_simple() == doctest::Approx(1.26202273350));
  CHECK(vibrated(100.0, 0.9, 1.0).temperature_refined() == doctest::Approx(0.69972238743));
  CHECK(vibrated(200.0, 0.9, 0.95).temperature_simple() == doctest::Approx(0.28845806455));
  CHECK(vibrated(200.0, 0.9, 0.95).temperature_refined() == doctest::Approx(0.15372497885));
  CHECK(vibrated(100.0, 1.0, 0.9).temperature_refined() == doctest::Approx(40.3364864856));
}

TEST_CASE("VibratedGas: Eq. (3.13), walls that lose nothing") {
  const VibratedGas gas = vibrated(100.0, 0.8, 1.0);
  const double loss = 0.36 * gas.psi();  // eps psi
  const double s = std::pow(2.0 / pi, 1.5) * (1.0 + std::sqrt(1.0 + 0.25 * pi * pi * loss)) / loss;
  CHECK(gas.temperature_simple() == doctest::Approx(s * s).epsilon(1e-13));
}

TEST_CASE("VibratedGas: temperatures scale with the drive speed squared") {
  VibratedGas gas = vibrated(100.0, 0.9, 0.95);
  const double simple = gas.temperature_simple();
  const double refined = gas.temperature_refined();
  gas.drive_speed = 3.0;
  CHECK(gas.temperature_simple() == doctest::Approx(9.0 * simple).epsilon(1e-14));
  CHECK(gas.temperature_refined() == doctest::Approx(9.0 * refined).epsilon(1e-14));
}

TEST_CASE("VibratedGas: nothing dissipates, nothing is stationary") {
  CHECK(std::isinf(vibrated(100.0, 1.0, 1.0).temperature_simple()));
  CHECK(std::isinf(vibrated(100.0, 1.0, 1.0).temperature_refined()));
}

TEST_CASE("VibratedGas: where next to nothing is lost, the linear gain alone balances it") {
  // s = sqrt(2/pi)/(eps psi) refined: alpha -> 1 leaves alpha_w + sqrt(alpha_w^2) = 2.
  const VibratedGas gas = vibrated(100.0, 1.0 - 1e-9, 1.0);
  const double s = std::sqrt(2.0 / pi) / (gas.epsilon_effective() * gas.psi());
  CHECK(gas.temperature_refined() == doctest::Approx(s * s).epsilon(1e-7));
}
