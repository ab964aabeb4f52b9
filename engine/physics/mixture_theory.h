#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace clatter {

/// Particles that are alike, as a part of a mixture.
struct MixtureComponent {
  std::size_t species = 0;  ///< number of the species that has their contact laws
  double count = 0.0;       ///< N_s > 0; need not be whole
  double diameter = 1.0;    ///< d_s
  double mass = 1.0;        ///< m_s
  double inertia = 0.5;     ///< q_s = 4I/(m d^2)
};

/// Contact law of two species, with a constant beta.
struct MixtureContact {
  double restitution = 1.0;              ///< alpha
  double tangential_restitution = -1.0;  ///< beta, -1: smooth
};

/// Temperatures of all components.
struct MixtureTemperatures {
  std::vector<double> translational;  ///< T_s
  std::vector<double> rotational;     ///< R_s = I <omega^2> per component of the spin; 0: no spins
};

/// Common state of free cooling: all temperatures fall at the same relative rate.
struct MixtureCooling {
  MixtureTemperatures ratios;  ///< T_s/T and R_s/T
  double rate = 0.0;           ///< (1/T) dT/dt < 0 at T = 1; it goes as sqrt(T)
};

/// The kinetic theory of a homogeneous mixture (theory 12.10-12.14): Enskog's collision rates
/// with Maxwell distributions. Boltzmann's constant is 1.
struct MixtureGas {
  int dimension = 2;    ///< D, 2: disks, 3: spheres
  double volume = 1.0;  ///< of the box; in 2D its area
  std::vector<MixtureComponent> components;
  std::size_t species = 1;               ///< S, number of species
  std::vector<MixtureContact> contacts;  ///< [S x S], symmetric

  /// N of all components.
  double count() const;
  /// N of a species.
  double count_of(std::size_t species) const;
  /// M, the mass of all particles.
  double mass() const;
  /// <d^k>, mean over all particles.
  double moment(int power) const;
  /// phi, the share of the box that particles fill.
  double packing_fraction() const;
  /// T = sum x_s T_s.
  double mean(const std::vector<double>& of_components) const;
  /// The mean over the components of one species.
  double mean_of(std::size_t species, const std::vector<double>& of_components) const;
  /// Temperatures that are all equal, without spins.
  MixtureTemperatures equal(double temperature) const;

  /// chi, pair correlation at contact of particles of two diameters (theory 12.11): of disks by
  /// Jenkins & Mancini (1987), of spheres by Boublik (1970), Grundke & Henderson (1972), Lee &
  /// Levesque (1973).
  double contact_correlation(double first, double second) const;
  /// Z = p V/(N T) of an elastic gas (theory 12.12): of spheres by Mansoori, Carnahan, Starling &
  /// Leland (1971).
  double compressibility() const;
  /// p V/(N T) of an inelastic gas at these temperatures (theory 12.13).
  double compressibility(const MixtureTemperatures& temperatures) const;
  /// nu, collisions of one particle of a component with another component, per time (theory 12.10).
  /// A particle does not collide with itself: of its own species it has N_s - 1 partners.
  double collision_rate(std::size_t component, std::size_t other,
                        const MixtureTemperatures& temperatures) const;
  /// Collisions between two species per time, of all particles.
  double pair_rate(std::size_t first, std::size_t second,
                   const MixtureTemperatures& temperatures) const;
  /// gamma, rate at which smooth collisions damp the velocity of one particle of a component
  /// relative to the others (theory 12.22).
  double friction(std::size_t component, const MixtureTemperatures& temperatures) const;
  /// Whether collisions change the spins of a component.
  bool spins(std::size_t component) const;
  /// Changes of all temperatures per time by collisions (theory 12.14).
  MixtureTemperatures changes(const MixtureTemperatures& temperatures) const;

  /// The state that free cooling approaches. Absent if the equations do not converge. Some contact
  /// must dissipate.
  std::optional<MixtureCooling> cooling() const;
  /// The stationary temperatures under driving that changes them by `heating` per time. Absent if
  /// the equations do not converge. Some contact must dissipate.
  std::optional<MixtureTemperatures> driven(const MixtureTemperatures& heating) const;

  /// H, power per particle of kicks of these standard deviations per component of the velocity,
  /// every `interval` (theory 12.6); the momentum of all is removed.
  std::vector<double> kick_powers(const std::vector<double>& kick_speeds, double interval) const;
  /// T_s of an elastic gas whose momentum is conserved and 0 (theory 12.15), at a mean temperature.
  std::vector<double> elastic_temperatures(double temperature) const;

 private:
  // nu over the root of the variance of the relative velocity, which does not depend on T.
  double rate_factor(std::size_t component, std::size_t other) const;
  std::vector<double> rate_factors() const;  // [components x components]
  MixtureTemperatures changes(const MixtureTemperatures& temperatures,
                              const std::vector<double>& rate_factors) const;
  double partners(const MixtureComponent& first, const MixtureComponent& second) const;
  const MixtureContact& contact(const MixtureComponent& first,
                                const MixtureComponent& second) const;
};

}  // namespace clatter
