#pragma once

namespace clatter {

/// The kinetic theory of a gas of smooth disks between two vibrated walls, section 5. Masses,
/// diameters and Boltzmann's constant are 1. "Simple" averages over all disks, "refined" over those
/// that collide, "corrected" is refined and counts how much denser the gas is at the walls.
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
  /// Stationary temperature of the simple theory, Eq. (3.12); infinite where disks and walls do not
  /// dissipate, eps_eff <= 0. So are the other two.
  double temperature_simple() const;
  /// Stationary temperature of the refined theory, Eq. (3.14): averages over the disks that
  /// collide.
  double temperature_refined() const;
  /// Stationary temperature of the refined theory where the walls are hit wall_layer_factor() times
  /// as often, section 5; good near the elastic limit.
  double temperature_corrected() const;

  /// kappa = (1 + 2 phi chi) Lx/(Lx - a), section 5: how many times more often than Eq. (3.3) says
  /// the walls are hit.
  double wall_layer_factor() const;
  /// f_pw, hits of one wall per time in the simple theory, Eq. (3.3).
  double wall_hit_rate(double temperature) const;
  /// f_pp, collisions of all disks per time, Eq. (3.5).
  double collision_rate(double temperature) const;
  /// dE_pw, energy that a hit of a wall brings in the simple theory, Eq. (3.2).
  double energy_per_wall_hit(double temperature) const;
  /// dE_pp <= 0, energy that a collision of disks brings in the simple theory, Eq. (3.4).
  double energy_per_collision(double temperature) const;
  /// dT/dt in the simple theory, Eq. (3.7).
  double temperature_change_simple(double temperature) const;
  /// dT/dt in the refined theory, Eq. (3.7) with averages over the disks that collide.
  double temperature_change_refined(double temperature) const;

  /// k of haff_temperature in the simple theory, Eq. (3.10), where nothing drives; per time.
  double haff_rate_simple(double initial_temperature) const;
  /// k in the refined theory, twice the simple one.
  double haff_rate_refined(double initial_temperature) const;
  /// k in the refined theory where the walls are hit wall_layer_factor() times as often.
  double haff_rate_corrected(double initial_temperature) const;
};

/// The kinetic theory of a gas of rough disks with constant beta in a periodic box, section 5.
struct RoughGas {
  double restitution = 1.0;              ///< alpha
  double tangential_restitution = -1.0;  ///< beta in -1..1
  double inertia = 0.5;                  ///< q = 4I/(m a^2) > 0

  /// eta = q (1 + beta)/(2 (1 + q)), Eq. (2.4).
  double eta() const;
  /// A = (1 - alpha^2)/2 + eta (1 - eta): per collision of a disk, the translational temperature
  /// loses A T_tr and gains B T_rot.
  double translational_loss() const;
  /// B = eta^2/q.
  double exchange() const;
  /// C = (eta/q) (1 - eta/q): per collision of a disk, the rotational temperature loses 2 C T_rot
  /// and gains 2 B T_tr.
  double rotational_loss() const;
  /// R = T_rot/T_tr that free cooling tends to; beta > -1.
  double cooling_ratio() const;
  /// R = T_rot/T_tr where kicks drive the translation only.
  double driven_ratio() const;
  /// T_tr where kicks drive the translation only, with `power` H per disk; see bulk_drive_power.
  double driven_temperature(double area_fraction, double power) const;
};

/// chi = (1 - 7 phi/16) / (1 - phi)^2, pair correlation of hard disks at contact, Eq. (3.6)
/// (Henderson 1975).
double contact_correlation(double area_fraction);

/// omega_E = 2 sqrt(pi) chi rho a sqrt(T/m), Enskog's collisions per disk and time, Eq. (3.5);
/// rho = 4 phi/pi.
double enskog_rate(double area_fraction, double temperature);

/// Z = p/(rho T) = 1 + (1 + alpha) phi chi, section 5: equation of state of the periodic gas.
double compressibility(double area_fraction, double restitution);

/// T = T_0/(1 + k t)^2, Haff's law, Eq. (3.10).
double haff_temperature(double initial_temperature, double rate, double time);

/// k of haff_temperature in a periodic box, section 5: (1 - alpha^2) omega_E(T_0)/4.
double haff_rate_periodic(double area_fraction, double restitution, double initial_temperature);

/// t* = 1/|k|, when the temperature of Haff's law with k < 0 diverges (alpha_w > 1, section 3.1);
/// infinite for k >= 0.
double divergence_time(double rate);

/// H = m s^2 (1 - 1/N)/dt, power per disk of kicks with standard deviation s per component every
/// dt, section 4.
double bulk_drive_power(double count, double kick_speed, double interval);

}  // namespace clatter
