#pragma once

namespace clatter {

/// The kinetic theory of a gas of smooth particles between two vibrated walls (theory 7). Masses,
/// diameters and Boltzmann's constant are 1. The simple theory averages over all particles, the
/// refined theory over particles that collide. The corrected theory is the refined theory with the
/// higher density at the walls.
struct VibratedGas {
  double count = 0.0;             ///< N
  double length = 0.0;            ///< Lx, between the walls
  double wall_size = 0.0;         ///< of either wall: Ly of disks, Ly Lz of spheres
  double restitution = 1.0;       ///< alpha
  double wall_restitution = 1.0;  ///< alpha_w of both walls
  double drive_speed = 0.0;       ///< v_dr of both walls
  int dimension = 2;              ///< 2: disks, 3: spheres

  /// phi of the whole box, see packing_fraction.
  double packing_fraction() const;
  /// psi = omega_E Lx / sqrt(2 pi T/m) (theory 7.5): sqrt(2) chi lambda a of disks, 2 sqrt(2) chi
  /// lambda a^2 of spheres, where lambda is N over the size of a wall.
  double psi() const;
  /// eps_eff = (1 - alpha^2) + (2/pi) (1 - alpha_w^2) / psi (theory 7.6).
  double epsilon_effective() const;
  /// Stationary temperature of the simple theory (theory 7.10). This and the two temperatures below
  /// are infinite without dissipation, for eps_eff <= 0.
  double temperature_simple() const;
  /// Stationary temperature of the refined theory (theory 7.11): averages over the particles
  /// that collide.
  double temperature_refined() const;
  /// Stationary temperature of the refined theory with the wall hit rate multiplied by
  /// wall_layer_factor() (theory 7.14); accurate near the elastic limit.
  double temperature_corrected() const;

  /// kappa = Z Lx/(Lx - a) (theory 7.13), with the compressibility Z of the elastic gas: the ratio
  /// of the wall hit rate to (theory 7.2).
  double wall_layer_factor() const;
  /// f_pw, hits of one wall per time in the simple theory (theory 7.2).
  double wall_hit_rate(double temperature) const;
  /// f_pp, collisions of all particles per time (theory 7.4).
  double collision_rate(double temperature) const;
  /// dE_pw, mean energy gain per wall hit in the simple theory (theory 7.1).
  double energy_per_wall_hit(double temperature) const;
  /// dE_pp <= 0, mean energy gain per collision of particles in the simple theory (theory 7.3).
  double energy_per_collision(double temperature) const;
  /// dT/dt in the simple theory (theory 7.7).
  double temperature_change_simple(double temperature) const;
  /// dT/dt in the refined theory (theory 7.8), with averages over the particles that collide.
  double temperature_change_refined(double temperature) const;

  /// k of haff_temperature in the simple theory (theory 7.12), without drive; per time.
  double haff_rate_simple(double initial_temperature) const;
  /// k in the refined theory, twice the simple one.
  double haff_rate_refined(double initial_temperature) const;
  /// k in the refined theory with the wall hit rate multiplied by wall_layer_factor().
  double haff_rate_corrected(double initial_temperature) const;
};

/// The kinetic theory of a gas of rough particles with constant beta in a periodic box
/// (theory 6.7).
struct RoughGas {
  double restitution = 1.0;              ///< alpha
  double tangential_restitution = -1.0;  ///< beta in -1..1
  double inertia = 0.5;                  ///< q = 4I/(m a^2) > 0
  int dimension = 2;                     ///< D, 2: disks, 3: spheres

  /// eta = q (1 + beta)/(2 (1 + q)) (theory 3.4).
  double eta() const;
  /// A = (1 - alpha^2)/(2(D-1)) + eta (1 - eta): the translational temperature loses A T_tr and
  /// gains B T_rot, times 2(D-1)/D per collision of a particle.
  double translational_loss() const;
  /// B = eta^2/q.
  double exchange() const;
  /// C = (eta/q) (1 - eta/q): the rotational temperature loses C T_rot and gains B T_tr, times
  /// 2(D-1)/D times 2/(D-1), the ratio of the degrees of freedom, per collision of a particle.
  double rotational_loss() const;
  /// Limit of R = T_rot/T_tr in free cooling; beta > -1.
  double cooling_ratio() const;
  /// R = T_rot/T_tr with kicks of the translation only.
  double driven_ratio() const;
  /// T_tr with kicks of the translation only, of `power` H per particle; see bulk_drive_power.
  double driven_temperature(double packing_fraction, double power) const;
};

/// phi, the packing fraction of particles of unit diameter: pi/4 times the number of disks per
/// area, pi/6 times the number of spheres per volume.
double packing_fraction(int dimension, double density);

/// phi of the closest packing: pi/(2 sqrt 3) of disks on a triangular lattice, pi/(3 sqrt 2) of
/// spheres on a face-centred cubic one.
double closest_packing(int dimension);

/// chi, pair correlation at contact: of hard disks (1 - 7 phi/16) / (1 - phi)^2 (theory 6.1)
/// (Henderson 1975), of hard spheres (1 - phi/2) / (1 - phi)^3 (Carnahan & Starling 1969).
double contact_correlation(double packing_fraction, int dimension = 2);

/// omega_E = S chi rho a^(D-1) sqrt(T/(pi m)), Enskog's collisions per particle and time
/// (theory 6.2); S = 2 pi is the circumference of the unit circle, 4 pi the area of the unit
/// sphere.
double enskog_rate(double packing_fraction, double temperature, int dimension = 2);

/// Z = p/(rho T) = 1 + 2^(D-2) (1 + alpha) phi chi, equation of state of the periodic gas
/// (theory 6.3).
double compressibility(double packing_fraction, double restitution, int dimension = 2);

/// T = T_0/(1 + k t)^2, Haff's law (theory 6.5).
double haff_temperature(double initial_temperature, double rate, double time);

/// k of haff_temperature in a periodic box (theory 6.6): (1 - alpha^2) omega_E(T_0)/(2D).
double haff_rate_periodic(double packing_fraction, double restitution, double initial_temperature,
                          int dimension = 2);

/// t* = 1/|k|, time of the divergence of Haff's law with k < 0 (alpha_w > 1, theory 7.16); infinite
/// for k >= 0.
double divergence_time(double rate);

/// H = (D/2) m s^2 (1 - 1/N)/dt, power per particle of kicks with standard deviation s per
/// component every dt (theory 5.2).
double bulk_drive_power(double count, double kick_speed, double interval, int dimension = 2);

}  // namespace clatter
