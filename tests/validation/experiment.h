#pragma once

#include <cmath>
#include <cstdint>

#include "engine/measure/measurement.h"
#include "tests/support/scenes.h"

namespace clatter::testing {

/// A gas of the given packing fraction in a square or cubic, periodic box.
Scene gas_of_fraction(double packing_fraction, int count, double restitution, int dimension = 2);

/// The standard gas of these tests: N = 100 in 20 x 25 between vibrated walls, v_dr = 1.
Scene vibrated_gas(double restitution, double wall_restitution);

/// Runs the [measure] block of a scene, with the given `burn_in` and `duration`.
Measured run(Scene scene, double burn_in, double duration, std::uint64_t seed);

/// Checks the energy balance of a stationary gas with `count` particles: the energy from walls,
/// kicks, gravity and shear equals the loss in collisions. The limits are 5 standard errors, and
/// the energy of the gas. The second limit is much tighter.
void check_energy_balance(const Measured& measured, int count);

/// The compressibility of the fluid of elastic hard spheres: the power series in phi/(1 - phi) of
/// Kolafa, Labik & Malijevsky 2004, Phys. Chem. Chem. Phys. 6, 2335, with the coefficients of
/// Pieprzyk, Bannerman, Branka, Chudak & Heyes 2019, Phys. Chem. Chem. Phys. 21, 6886.
double sphere_compressibility(double packing_fraction);

/// Deviation from an expected value, relative to it.
inline double relative(const Estimate& estimate, double expected) {
  return estimate.mean / expected - 1.0;
}

/// Standard error relative to the mean.
inline double relative_error(const Estimate& estimate) {
  return estimate.standard_error / std::fabs(estimate.mean);
}

}  // namespace clatter::testing
