#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/laws/wall.h"
#include "engine/scene/view.h"

namespace clatter {

/// Distribution of the diameters of a species.
enum class Spread {
  Uniform,    ///< from d (1 - width) to d (1 + width)
  Gaussian,   ///< standard deviation d width, cut at 3 standard deviations
  Lognormal,  ///< mean d and standard deviation d width; the logarithm is cut at 3 of its own
};

/// Unequal diameters within a species.
struct Polydispersity {
  Spread kind = Spread::Uniform;
  double width = 0.1;  ///< > 0, relative to the diameter d of the species

  bool operator==(const Polydispersity&) const = default;
};

/// One kind of particles of a mixture.
struct Species {
  std::string name;               ///< of letters, digits, _ and -; no two species have the same
  int count = 0;                  ///< N_s >= 0; from its packing fraction if the scene has that
  double diameter = 1.0;          ///< d_s > 0; of unequal diameters the mean
  std::optional<double> mass;     ///< m_s > 0 of a particle of diameter d_s; absent: by the density
  double density = 1.0;           ///< m_s / d_s^D > 0, without a mass
  std::optional<double> inertia;  ///< q_s = 4I/(m d^2), 0..1; absent: that of [particles]
  std::optional<int> count_left;  ///< of them start below the divider, see count_left()
  std::optional<Polydispersity> polydispersity;  ///< absent: all diameters are d_s
  std::optional<Rgb> colour;                     ///< in pictures; absent: one of the palette

  bool operator==(const Species&) const = default;

  /// Mass of a particle of diameter d_s, in D dimensions.
  double mass_in(int dimension) const {
    const double area = diameter * diameter;
    return mass.value_or(density * (dimension == 2 ? area : area * diameter));
  }
  /// Diameter of particle `number` of `total` particles, in increasing order: the quantile
  /// (number + 1/2) / total of the distribution.
  double diameter_of(int number, int total) const { return quantile((number + 0.5) / total); }
  /// Limits of the diameters.
  double smallest_diameter() const { return quantile(0.0); }
  double largest_diameter() const { return quantile(1.0); }
  /// The diameter that a share of the particles does not reach.
  double quantile(double share) const;
  /// Mean of the power of the diameters; of more than 1000 particles that of 1000 quantiles.
  double mean_power(int power) const;
};

/// Contact law of two species, as far as it differs from that of [particles].
struct SpeciesPair {
  std::vector<std::string> species;   ///< [2] names, in either order; may be the same
  std::optional<double> restitution;  ///< alpha, 0..1
  Roughness roughness = {};

  bool operator==(const SpeciesPair&) const = default;
};

/// A wall as one species meets it, as far as it differs.
struct SpeciesWall {
  std::optional<double> restitution;
  Roughness roughness = {};
  std::optional<double> drive_speed;
  std::optional<double> temperature;

  bool operator==(const SpeciesWall&) const = default;
};

/// Whether a text can be the name of a species.
bool is_species_name(std::string_view name);

/// Number of particles of all species.
int count_of(const std::vector<Species>& species);

/// The names of species.
std::vector<std::string> names_of(const std::vector<Species>& species);

/// The number of the species of a name; absent without one.
std::optional<std::size_t> find_species(const std::vector<Species>& species, std::string_view name);

/// The wall that a species meets.
Wall wall_of_species(const Wall& wall, const SpeciesWall& differences);

/// A roughness with the values that another one gives.
Roughness with_differences(const Roughness& roughness, const Roughness& differences);

}  // namespace clatter
