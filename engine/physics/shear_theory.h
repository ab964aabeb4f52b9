#pragma once

namespace clatter {

/// Steady shear of particles of unit diameter and mass that lose energy in collisions
/// (theory 14.3).
struct ShearTheory {
  double temperature = 0.0;  ///< T without the flow
  double stress_xx = 0.0;    ///< over minus the pressure rho T: P_xx/p
  double stress_yy = 0.0;    ///< P_yy/p
  double stress_yx = 0.0;    ///< P_yx/p, of the sign of minus the rate
};

/// Grad's solution for dilute smooth particles: rate != 0, 0 < alpha < 1.
ShearTheory grad_shear(double packing_fraction, double restitution, double rate, int dimension);

/// Steady temperature of nearly elastic particles at any fluid density, by Enskog's viscosity and
/// loss. The same requirements.
double enskog_shear_temperature(double packing_fraction, double restitution, double rate,
                                int dimension);

/// Enskog's shear viscosity of elastic particles at a temperature.
double enskog_viscosity(double packing_fraction, double temperature, int dimension);

}  // namespace clatter
