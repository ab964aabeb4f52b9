#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "engine/physics/collision.h"
#include "engine/physics/theory.h"

using namespace clatter;
using std::numbers::pi;

namespace {

/// The standard gases of these tests: 20 x 25 diameters.
VibratedGas vibrated(double count, double restitution, double wall_restitution) {
  return {count, 20.0, 25.0, restitution, wall_restitution, 1.0};
}

/// T_tr and T_rot of rough particles.
struct Temperatures {
  double translational = 1.0, rotational = 0.0;
};

/// d/dt of both in a gas of area fraction .2, without the names A, B and C. The energies (theory
/// 3.6) are averaged over colliding pairs at half of Enskog's rate per particle. The averages of
/// g_n^2, g_t^2 and g_t v_t are 4 T_tr, 2 T_tr + 2 T_rot/q and 2 T_tr.
Temperatures rough_change(const RoughGas& gas, const Temperatures& T, double power) {
  const double alpha = gas.restitution, beta = gas.tangential_restitution, q = gas.inertia;
  const double eta = gas.eta();
  const double g_t_squared = 2.0 * T.translational + 2.0 * T.rotational / q;
  const double normal_loss = (1.0 - alpha * alpha) * T.translational;
  const double translational = -normal_loss - 2.0 * eta * T.translational + eta * eta * g_t_squared;
  const double both =
      -normal_loss - 0.25 * q / (1.0 + q) * (1.0 - beta * beta) * g_t_squared;  // T_tr + T_rot/2
  const double rate = 0.5 * enskog_rate(0.2, T.translational);
  return {rate * translational + power, 2.0 * rate * (both - translational)};
}

/// Mean energy gains in a collision: of the centres, and of the spins.
struct Gains {
  double translational = 0.0, rotational = 0.0;
};

/// These gains from the collision rule itself. Both are quadratic in the velocities of independent
/// Gaussian variables. Each variable alone, at its standard deviation, therefore gives its share of
/// the mean exactly. For colliding particles <g_n^2> = 4 T_tr.
template <int D>
Gains mean_gains(const RoughGas& gas, const Temperatures& T) {
  const double moment = 0.25 * gas.inertia;
  const ContactLaw law = {gas.restitution, std::numeric_limits<double>::infinity(),
                          gas.tangential_restitution};
  const Vec<D> n = Vec<3>(2.0, -3.0, 6.0).head<D>().normalized();
  Gains gains;
  const auto add = [&](const Vec<D>& v, const Spin<D>& first, const Spin<D>& second) {
    const Grain grain = {.inertia = gas.inertia};
    const Impulse<D> impulse =
        rough_impulse<D>(n, v, 0.5 * (first + second), law, {grain, grain}).of(0);
    // In the frame of both centres of mass.
    gains.translational += (0.5 * v + impulse.momentum).squaredNorm() - 0.25 * v.squaredNorm();
    gains.rotational += 0.5 * moment *
                        ((first + impulse.spin).squaredNorm() - first.squaredNorm() +
                         (second + impulse.spin).squaredNorm() - second.squaredNorm());
  };
  const Spin<D> none = Spin<D>::Zero();
  add(-std::sqrt(4.0 * T.translational) * n, none, none);
  for (int axis = 0; axis < D; ++axis) {
    // D dependent deviations: the sum of (I - n n) over unit vectors gives the tangents.
    const Vec<D> unit = Vec<D>::Unit(axis);
    add(std::sqrt(2.0 * T.translational) * (unit - n.dot(unit) * n), none, none);
  }
  for (int axis = 0; axis < kSpinSize<D>; ++axis) {
    const Spin<D> spin = std::sqrt(T.rotational / moment) * Spin<D>::Unit(axis);
    add(Vec<D>::Zero(), spin, none);
    add(Vec<D>::Zero(), none, spin);
  }
  return gains;
}

// T_tr loses A T_tr and gains B T_rot, times 2(D-1)/D per collision of a particle. A collision of
// two particles with energy D T_tr changes it by 2(D-1) times this, and the energy of the spins
// too.
template <int D>
void check_rough_coefficients() {
  CAPTURE(D);
  for (const double alpha : {0.5, 0.8, 1.0}) {
    for (const double beta : {-0.9, 0.0, 0.5, 1.0}) {
      for (const double q : {0.4, 0.5, 1.0}) {
        const RoughGas gas = {alpha, beta, q, D};
        for (const Temperatures& T : {Temperatures{1.0, 0.0}, {0.0, 1.0}, {1.7, 0.6}}) {
          const Gains gains = mean_gains<D>(gas, T);
          const double factor = 2.0 * (D - 1);
          const double translational =
              gas.exchange() * T.rotational - gas.translational_loss() * T.translational;
          const double rotational =
              gas.exchange() * T.translational - gas.rotational_loss() * T.rotational;
          // The gains are differences of energies.
          const double rounding = 2e-15 * factor * (T.translational + T.rotational);
          CHECK(std::fabs(gains.translational - factor * translational) < rounding);
          CHECK(std::fabs(gains.rotational - factor * rotational) < rounding);
        }
      }
    }
  }
}

/// The temperatures after 1000 collisions per particle from T_tr = 1, by fourth-order Runge-Kutta.
/// T_tr is kept at 1 without a drive, which does not change the ratio.
Temperatures evolved(const RoughGas& gas, Temperatures T, double power) {
  const double step = 0.05 / enskog_rate(0.2, 1.0);
  const auto ahead = [](const Temperatures& T, const Temperatures& change, double time) {
    return Temperatures{T.translational + change.translational * time,
                        T.rotational + change.rotational * time};
  };
  for (int i = 0; i < 20000; ++i) {
    const Temperatures k1 = rough_change(gas, T, power);
    const Temperatures k2 = rough_change(gas, ahead(T, k1, 0.5 * step), power);
    const Temperatures k3 = rough_change(gas, ahead(T, k2, 0.5 * step), power);
    const Temperatures k4 = rough_change(gas, ahead(T, k3, step), power);
    T = ahead(ahead(T, k1, step / 6.0), k2, step / 3.0);
    T = ahead(ahead(T, k3, step / 3.0), k4, step / 6.0);
    if (power == 0.0) T = {1.0, T.rotational / T.translational};
  }
  return T;
}

}  // namespace

TEST_CASE("Theory: chi follows theory 6.1") {
  CHECK(contact_correlation(0.0) == 1.0);
  CHECK(contact_correlation(0.5) == doctest::Approx(3.125).epsilon(1e-15));       // (25/32) / (1/4)
  CHECK(contact_correlation(0.2) == doctest::Approx(1.42578125).epsilon(1e-14));  // .9125/.64
}

TEST_CASE("Theory: the pressure of hard spheres follows Carnahan and Starling (1969)") {
  // Z = (1 + phi + phi^2 - phi^3)/(1 - phi)^3.
  for (const double phi : {0.0, 0.1, 0.3, 0.49}) {
    const double state = (1.0 + phi + phi * phi - phi * phi * phi) / std::pow(1.0 - phi, 3);
    CHECK(compressibility(phi, 1.0, 3) == doctest::Approx(state).epsilon(1e-15));
  }
  // Each impulse is (1 + alpha)/2 of the elastic one.
  const double elastic = compressibility(0.3, 1.0, 3) - 1.0;
  CHECK(compressibility(0.3, 0.6, 3) == doctest::Approx(1.0 + 0.8 * elastic).epsilon(1e-15));
}

TEST_CASE("Theory: spheres fill pi/6 of their number per volume") {
  CHECK(packing_fraction(3, 0.6) == doctest::Approx(0.1 * pi).epsilon(1e-15));
  CHECK(packing_fraction(2, 0.4) == doctest::Approx(0.1 * pi).epsilon(1e-15));
}

TEST_CASE("Theory: the compressibility has its virial limit and the factor (1 + alpha)/2") {
  CHECK(compressibility(0.0, 1.0) == 1.0);
  CHECK(compressibility(0.5, 1.0) == doctest::Approx(4.125).epsilon(1e-15));  // 1 + 2 * .5 * 3.125
  // Each impulse is (1 + alpha)/2 of the elastic one.
  CHECK(compressibility(0.5, 0.6) == doctest::Approx(1.0 + 0.8 * 3.125).epsilon(1e-15));
  // Second virial coefficient of hard disks: pi a^2/2 per particle, so Z = 1 + 2 phi + ...
  CHECK((compressibility(1e-6, 1.0) - 1.0) / 1e-6 == doctest::Approx(2.0).epsilon(1e-5));
}

TEST_CASE("Theory: Enskog's rate follows theory 6.2, and the kinetic rate when dilute") {
  // chi(.1) = .95625/.81, rho = .4/pi: 2 sqrt(pi) * 1.1805556 * .1273240.
  CHECK(enskog_rate(0.1, 1.0) == doctest::Approx(0.5328457177951).epsilon(1e-12));
  CHECK(enskog_rate(0.1, 9.0) == doctest::Approx(3.0 * enskog_rate(0.1, 1.0)).epsilon(1e-14));
  CHECK(enskog_rate(0.1, 0.0) == 0.0);
  // Dilute: mean relative speed sqrt(pi T) times the cross-section 2a times rho.
  const double rho = 4.0 * 1e-6 / pi;
  CHECK(enskog_rate(1e-6, 2.0) == doctest::Approx(2.0 * rho * std::sqrt(2.0 * pi)).epsilon(1e-5));
}

TEST_CASE("Theory: Enskog's rate of spheres is the kinetic one times chi") {
  // Mean relative speed 4 sqrt(T/pi), cross-section pi a^2; chi(.3) = .85/.343.
  const double density = 0.3 * 6.0 / pi;
  const double kinetic = pi * density * 4.0 * std::sqrt(2.0 / pi);
  CHECK(enskog_rate(0.3, 2.0, 3) == doctest::Approx(kinetic * 0.85 / 0.343).epsilon(1e-14));
}

TEST_CASE("VibratedGas: of spheres it is the balance of their rates and energies") {
  // 200 spheres between walls of area 30 at a distance of 12, alpha = .9, alpha_w = .95, v_dr
  // = 1, T = 1.7. Independently evaluated from omega_E = n chi pi a^2 4 sqrt(T/pi) and the balance
  // (3N/2) dT/dt = 2 f_pw dE_pw + N omega_E dE_pp/2. The temperatures are from bisection.
  const VibratedGas gas = {200.0, 12.0, 30.0, 0.9, 0.95, 1.0, 3};
  CHECK(gas.packing_fraction() == doctest::Approx(0.29088820866572).epsilon(1e-13));
  CHECK(gas.psi() == doctest::Approx(45.190806092675).epsilon(1e-13));
  CHECK(gas.epsilon_effective() == doctest::Approx(0.19137351893389).epsilon(1e-13));
  CHECK(gas.wall_hit_rate(1.7) == doctest::Approx(8.6692849131002).epsilon(1e-13));
  CHECK(gas.collision_rate(1.7) == doctest::Approx(1224.6340139672).epsilon(1e-12));
  CHECK(gas.temperature_change_simple(1.7) == doctest::Approx(-0.58134740461123).epsilon(1e-13));
  CHECK(gas.temperature_change_refined(1.7) == doctest::Approx(-1.2161080847521).epsilon(1e-12));
  CHECK(gas.temperature_simple() == doctest::Approx(0.110749421296).epsilon(1e-11));
  CHECK(gas.temperature_refined() == doctest::Approx(0.05789473496501).epsilon(1e-12));
  CHECK(gas.wall_layer_factor() == doctest::Approx(4.132991838648).epsilon(1e-13));
  CHECK(gas.temperature_corrected() == doctest::Approx(0.3618969486311).epsilon(1e-12));
  CHECK(gas.haff_rate_simple(1.7) == doctest::Approx(0.1962835181399).epsilon(1e-12));
  CHECK(gas.haff_rate_refined(1.7) == doctest::Approx(0.3925670362798).epsilon(1e-12));
  CHECK(gas.haff_rate_corrected(1.7) == doctest::Approx(0.40139429591569).epsilon(1e-12));
  // Elastic walls have no effect: the periodic box cools at the same rate.
  const VibratedGas lossless = {200.0, 12.0, 30.0, 0.9, 1.0, 0.0, 3};
  CHECK(
      lossless.haff_rate_refined(1.7) ==
      doctest::Approx(haff_rate_periodic(lossless.packing_fraction(), 0.9, 1.7, 3)).epsilon(1e-13));
}

TEST_CASE("VibratedGas: its parameters follow theory 7.5 and 7.6") {
  const VibratedGas gas = vibrated(200.0, 0.9, 0.95);
  CHECK(gas.packing_fraction() == doctest::Approx(pi / 10.0).epsilon(1e-15));
  // sqrt(2) * 1.8337511829 * 200/25
  CHECK(gas.psi() == doctest::Approx(20.746526342878).epsilon(1e-12));
  // .19 + (2/pi) * .0975/psi
  CHECK(gas.epsilon_effective() == doctest::Approx(0.192991846769).epsilon(1e-11));
  CHECK(vibrated(200.0, 0.9, 1.0).epsilon_effective() == doctest::Approx(0.19).epsilon(1e-14));
}

TEST_CASE("VibratedGas: dT/dt is zero at the stationary temperatures, and drives others there") {
  const auto check = [](double temperature, const auto& change) {
    CHECK(change(1.01 * temperature) < 0.0);
    CHECK(change(0.99 * temperature) > 0.0);
    CHECK(std::fabs(change(temperature)) < 1e-9 * std::fabs(change(1.01 * temperature)));
  };
  for (const double restitution : {0.5, 0.9, 0.99, 1.0}) {
    for (const double wall_restitution : {0.3, 0.9, 1.0}) {
      if (restitution == 1.0 && wall_restitution == 1.0) continue;
      for (const double count : {20.0, 100.0, 400.0}) {
        const VibratedGas gas = vibrated(count, restitution, wall_restitution);
        check(gas.temperature_simple(), [&](double T) { return gas.temperature_change_simple(T); });
        check(gas.temperature_refined(),
              [&](double T) { return gas.temperature_change_refined(T); });
      }
    }
  }
}

TEST_CASE("VibratedGas: the temperatures are those found by bisection of theory 7.7 and 7.8") {
  // Independently computed, by bisection of the two brackets.
  CHECK(vibrated(100.0, 0.9, 1.0).temperature_simple() == doctest::Approx(1.26202273350));
  CHECK(vibrated(100.0, 0.9, 1.0).temperature_refined() == doctest::Approx(0.69972238743));
  CHECK(vibrated(200.0, 0.9, 0.95).temperature_simple() == doctest::Approx(0.28845806455));
  CHECK(vibrated(200.0, 0.9, 0.95).temperature_refined() == doctest::Approx(0.15372497885));
  CHECK(vibrated(100.0, 1.0, 0.9).temperature_refined() == doctest::Approx(40.3364864856));
}

TEST_CASE("VibratedGas: temperatures scale with the drive speed squared") {
  VibratedGas gas = vibrated(100.0, 0.9, 0.95);
  const double simple = gas.temperature_simple();
  const double refined = gas.temperature_refined();
  gas.drive_speed = 3.0;
  CHECK(gas.temperature_simple() == doctest::Approx(9.0 * simple).epsilon(1e-14));
  CHECK(gas.temperature_refined() == doctest::Approx(9.0 * refined).epsilon(1e-14));
}

TEST_CASE("VibratedGas: without dissipation there is no stationary temperature") {
  // The last gas gains more at the walls than its particles lose.
  for (const VibratedGas& gas :
       {vibrated(100.0, 1.0, 1.0), vibrated(200.0, 1.0, 1.05), vibrated(200.0, 0.995, 1.2)}) {
    CHECK(std::isinf(gas.temperature_simple()));
    CHECK(std::isinf(gas.temperature_refined()));
    CHECK(std::isinf(gas.temperature_corrected()));
  }
}

TEST_CASE("VibratedGas: a vanishing loss is balanced by the linear gain alone") {
  // s = sqrt(2/pi)/(eps psi) refined: alpha -> 1 leaves alpha_w + sqrt(alpha_w^2) = 2.
  const VibratedGas gas = vibrated(100.0, 1.0 - 1e-9, 1.0);
  const double s = std::sqrt(2.0 / pi) / (gas.epsilon_effective() * gas.psi());
  CHECK(gas.temperature_refined() == doctest::Approx(s * s).epsilon(1e-7));
}

TEST_CASE("VibratedGas: rates and energies follow theory 7.1-7.4") {
  // Independently evaluated at T = 1.7: 10 sqrt(T/2 pi); sqrt(pi) chi 200 * 199/500 sqrt(T); (1 +
  // 3.8 sqrt(T/2 pi) - .0975 T)/2; -.19 T/2.
  const VibratedGas gas = vibrated(200.0, 0.9, 0.95);
  CHECK(gas.wall_hit_rate(1.7) == doctest::Approx(5.2015709478601).epsilon(1e-13));
  CHECK(gas.collision_rate(1.7) == doctest::Approx(337.32837310827).epsilon(1e-13));
  CHECK(gas.energy_per_wall_hit(1.7) == doctest::Approx(1.4054234800934).epsilon(1e-13));
  CHECK(gas.energy_per_collision(1.7) == doctest::Approx(-0.1615).epsilon(1e-13));
  CHECK(gas.temperature_change_simple(1.7) == doctest::Approx(-0.20065736919313).epsilon(1e-13));
  // Refined: the mean velocity of hitting particles is sqrt(pi T/2), and both losses double.
  CHECK(gas.temperature_change_refined(1.7) == doctest::Approx(-0.44938668636292).epsilon(1e-12));
  // A collision belongs to two particles, each with N - 1 partners.
  CHECK(gas.collision_rate(1.7) ==
        doctest::Approx(0.5 * 199.0 * enskog_rate(gas.packing_fraction(), 1.7)).epsilon(1e-13));
}

TEST_CASE("VibratedGas: theory 7.7 is the balance of 7.1-7.4") {
  for (const double restitution : {0.5, 0.9, 1.0}) {
    for (const double wall_restitution : {0.3, 0.9, 1.0, 1.1}) {
      for (const double temperature : {0.01, 1.0, 30.0}) {
        const VibratedGas gas = vibrated(100.0, restitution, wall_restitution);
        const double at_walls =
            2.0 * gas.wall_hit_rate(temperature) * gas.energy_per_wall_hit(temperature);
        // (theory 7.7) has N instead of N - 1.
        const double at_particles =
            100.0 / 99.0 * gas.collision_rate(temperature) * gas.energy_per_collision(temperature);
        const double scale = std::fabs(at_walls) + std::fabs(at_particles);
        CHECK(std::fabs(100.0 * gas.temperature_change_simple(temperature) - at_walls -
                        at_particles) < 1e-13 * scale);
      }
    }
  }
}

TEST_CASE("VibratedGas: the wall layer makes hits more frequent, and the gas hotter") {
  // 1 + 2 phi chi = 1.41177119479, times 20/19. Independently evaluated.
  CHECK(vibrated(100.0, 1.0, 1.0).wall_layer_factor() ==
        doctest::Approx(1.4860749418871).epsilon(1e-13));
  // In a dilute gas the rate is larger only because centres have one diameter less to travel.
  CHECK(vibrated(1e-9, 1.0, 1.0).wall_layer_factor() == doctest::Approx(20.0 / 19.0).epsilon(1e-9));
  // Zeros of kappa [1 + alpha_w sqrt(2 pi T) - 2 (1 - alpha_w^2) T] - pi eps psi T, independently
  // computed by bisection.
  CHECK(vibrated(100.0, 0.9, 1.0).temperature_corrected() ==
        doctest::Approx(1.2927692782583).epsilon(1e-12));
  CHECK(vibrated(200.0, 0.9, 0.95).temperature_corrected() ==
        doctest::Approx(0.46278206398242).epsilon(1e-12));
  CHECK(vibrated(100.0, 0.99, 0.95).temperature_corrected() ==
        doctest::Approx(25.862167704689).epsilon(1e-12));
  // If only the walls heat and cool, the rate of hits has no effect.
  CHECK(vibrated(100.0, 1.0, 0.9).temperature_corrected() ==
        doctest::Approx(vibrated(100.0, 1.0, 0.9).temperature_refined()).epsilon(1e-14));
}

TEST_CASE("VibratedGas: Haff's rates follow theory 7.12") {
  // -dT/dt/(2 T) at T = 1.7 from rates times energies, independently evaluated. First simple
  // averages; then refined ones, which lose (1 - alpha_w^2) T at a wall and (1 - alpha^2) T at a
  // particle; then the refined ones with the wall contribution times kappa.
  const VibratedGas cooling = vibrated(200.0, 0.9, 0.95);
  CHECK(cooling.haff_rate_simple(1.7) == doctest::Approx(0.081785961926797).epsilon(1e-12));
  CHECK(cooling.haff_rate_refined(1.7) == doctest::Approx(0.16357192385359).epsilon(1e-12));
  CHECK(cooling.haff_rate_corrected(1.7) == doctest::Approx(0.16678081500197).epsilon(1e-12));
  const VibratedGas heating = vibrated(100.0, 1.0, 1.1);
  CHECK(heating.haff_rate_simple(1.7) == doctest::Approx(-0.0027308247476266).epsilon(1e-12));
  CHECK(heating.haff_rate_corrected(1.7) == doctest::Approx(-0.0081164204562660).epsilon(1e-12));
  // Elastic walls have no effect: the periodic box cools at the same rate.
  const VibratedGas lossless = vibrated(100.0, 0.9, 1.0);
  const double periodic = haff_rate_periodic(lossless.packing_fraction(), 0.9, 1.7);
  CHECK(lossless.haff_rate_refined(1.7) == doctest::Approx(periodic).epsilon(1e-13));
  CHECK(lossless.haff_rate_corrected(1.7) == doctest::Approx(periodic).epsilon(1e-13));
  // .19 * 2 * .5328457177951/4, see enskog_rate above.
  CHECK(haff_rate_periodic(0.1, 0.9, 4.0) == doctest::Approx(0.050620343190535).epsilon(1e-12));
}

TEST_CASE("Theory: Haff's law solves theory 7.7 without drive") {
  for (const double wall_restitution : {0.9, 1.1}) {
    VibratedGas gas = vibrated(100.0, 1.0, wall_restitution);
    gas.drive_speed = 0.0;
    const double k = gas.haff_rate_refined(1.7);
    for (const double time : {0.0, 10.0, 100.0}) {
      const double temperature = haff_temperature(1.7, k, time);
      const double step = 1e-4 / std::fabs(k);
      const double slope =
          (haff_temperature(1.7, k, time + step) - haff_temperature(1.7, k, time - step)) /
          (2.0 * step);
      CHECK(gas.temperature_change_refined(temperature) == doctest::Approx(slope).epsilon(1e-6));
    }
  }
  CHECK(haff_temperature(1.7, 0.3, 0.0) == 1.7);
  CHECK(haff_temperature(1.0, 0.5, 2.0) == 0.25);
}

TEST_CASE("Theory: Haff's law diverges at its divergence time") {
  CHECK(divergence_time(-0.25) == 4.0);
  CHECK(std::isinf(haff_temperature(1.0, -0.25, divergence_time(-0.25))));
  CHECK(std::isfinite(haff_temperature(1.0, -0.25, 3.999)));
  CHECK(divergence_time(0.0) == std::numeric_limits<double>::infinity());
  CHECK(divergence_time(0.25) == std::numeric_limits<double>::infinity());
  // (theory 7.16): without kappa the divergence would be 45 % late at N = 100 in 20 x 25.
  const VibratedGas gas = vibrated(100.0, 1.0, 1.1);
  const double late =
      divergence_time(gas.haff_rate_refined(1.0)) / divergence_time(gas.haff_rate_corrected(1.0));
  CHECK(late == doctest::Approx(1.45).epsilon(0.03));
}

TEST_CASE("RoughGas: the coefficients follow from the collision rule") {
  check_rough_coefficients<2>();
  check_rough_coefficients<3>();
}

TEST_CASE("RoughGas: of spheres, both ratios keep the shares of the temperatures") {
  for (const double beta : {-0.5, 0.0, 0.5, 1.0}) {
    const RoughGas gas = {0.8, beta, 0.4, 3};
    // During cooling, both temperatures fall at the same relative rate.
    const double R = gas.cooling_ratio();
    const Gains cooling = mean_gains<3>(gas, {1.0, R});
    CHECK(cooling.rotational / R == doctest::Approx(cooling.translational).epsilon(1e-13));
    // With a drive, collisions conserve the spin energy and dissipate the energy of the kicks.
    const Gains driven = mean_gains<3>(gas, {1.0, gas.driven_ratio()});
    CHECK(std::fabs(driven.rotational) < 1e-14);
    const double T = gas.driven_temperature(0.2, 0.03);
    const double collisions = 0.5 * enskog_rate(0.2, T, 3);  // per particle, two per collision
    CHECK(-collisions * T * driven.translational == doctest::Approx(0.03).epsilon(1e-13));
  }
}

TEST_CASE("RoughGas: temperatures tend to the ratios, whatever they begin with") {
  for (const double beta : {-0.5, 0.0, 0.5, 1.0}) {
    const RoughGas gas = {0.8, beta, 0.4};
    for (const double start : {0.0, 5.0}) {
      const Temperatures cooling = evolved(gas, {1.0, start}, 0.0);
      CHECK(cooling.rotational / cooling.translational ==
            doctest::Approx(gas.cooling_ratio()).epsilon(1e-9));
      const Temperatures driven = evolved(gas, {1.0, start}, 0.5);
      CHECK(driven.rotational / driven.translational ==
            doctest::Approx(gas.driven_ratio()).epsilon(1e-9));
      CHECK(driven.translational ==
            doctest::Approx(gas.driven_temperature(0.2, 0.5)).epsilon(1e-9));
    }
  }
  // Independently computed by bisection of the same averages.
  CHECK(RoughGas{0.8, 0.5, 0.4}.cooling_ratio() ==
        doctest::Approx(0.90682661274476).epsilon(1e-12));
  CHECK(RoughGas{0.8, 0.5, 0.4}.driven_ratio() == doctest::Approx(6.0 / 13.0).epsilon(1e-14));
  CHECK(RoughGas{0.8, 0.5, 0.4}.driven_temperature(0.2, 0.03) ==
        doctest::Approx(0.18397421484202).epsilon(1e-12));
}

TEST_CASE("RoughGas: energy is shared evenly without loss, and smooth particles have no spin") {
  // Equipartition holds for elastic perfectly rough particles. It also holds for driven perfectly
  // rough particles at any alpha.
  for (const double q : {0.4, 0.5, 1.0}) {
    CHECK(RoughGas{1.0, 1.0, q}.cooling_ratio() == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(RoughGas{0.7, 1.0, q}.driven_ratio() == doctest::Approx(1.0).epsilon(1e-14));
  }
  // Smooth particles: no spins, and the loss (theory 6.4) in a periodic box, H = 2 k T.
  const RoughGas smooth = {0.8, -1.0, 0.5};
  CHECK(smooth.driven_ratio() == 0.0);
  const double T = smooth.driven_temperature(0.2, 0.03);
  CHECK(2.0 * haff_rate_periodic(0.2, 0.8, T) * T == doctest::Approx(0.03).epsilon(1e-13));
}

TEST_CASE("Theory: the power of bulk driving is that without the mean kick") {
  // Two particles receive +-(k_1 - k_2)/2, of variance s^2/2 per component: s^2/2 each in two
  // dimensions.
  CHECK(bulk_drive_power(2.0, 0.5, 0.25) == 0.5);
  CHECK(bulk_drive_power(1.0, 0.5, 0.25) == 0.0);
  CHECK(bulk_drive_power(1e9, 0.5, 0.25) == doctest::Approx(1.0).epsilon(1e-8));
  CHECK(bulk_drive_power(2.0, 0.5, 0.25, 3) == 0.75);
}
