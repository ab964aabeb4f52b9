#pragma once

namespace clatter {

/// The kinetic theory of a gas of smooth disks between two vibrated walls, section 5. Masses,
/// diameters and Boltzmann's constant are 1.
struct VibratedGas {
  double count = 0.0;             ///< N
  double length = 0.0;            ///< Lx, between the walls
  double width = 0.0;             ///< Ly, along them
  double restitution = 1.0;       ///< alpha
  double wall_restitution = 1.0;  ///< alpha_w of both walls
  double drive_speed = 0.0;       ///< v_dr of both walls

  /// phi = N pi / (4 Lx Ly).
  double area_fraction() const;
  /// psi = sqrt(2) chi lambda a with lambda = N/Ly, Eq. (3.9).
  double psi() const;
  /// eps_eff = (1 - alpha^2) + (2/pi) (1 - alpha_w^2) / psi, Eq. (3.8).
  double epsilon_effective() const;
  /// Stationary temperature of the simple theory, Eq. (3.12); infinite where nothing dissipates.
  double temperature_simple() const;
  /// Stationary temperature of the refined theory, Eq. (3.14): averages over the disks that
  /// collide.
  double temperature_refined() const;
};

/// chi = (1 - 7 phi/16) / (1 - phi)^2, pair correlation of hard disks at contact, Eq. (3.6)
/// (Henderson 1975).
double contact_correlation(double area_fraction);

/// omega_E = 2 sqrt(pi) chi rho a sqrt(T/m), Enskog's collisions per disk and time, Eq. (3.5);
/// rho = 4 phi/pi.
double enskog_rate(double area_fraction, double temperature);

/// Z = p/(rho T) = 1 + (1 + alpha) phi chi, section 5: equation of state of the periodic gas.
double compressibility(double area_fraction, double restitution);

}  // namespace clatter
