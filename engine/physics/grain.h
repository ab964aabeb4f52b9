#pragma once

#include <cstdint>

namespace clatter {

/// What a particle is, the same for a whole run. The default is the particle whose diameter and
/// mass are the units.
struct Grain {
  double radius = 0.5;        ///< > 0
  double mass = 1.0;          ///< > 0
  double inertia = 0.5;       ///< q = 4I/(m a^2), with the diameter a
  std::uint32_t species = 0;  ///< number of its species

  /// I = q m a^2/4.
  double moment_of_inertia() const { return inertia * mass * radius * radius; }

  bool operator==(const Grain&) const = default;
};

/// The mass 1 of particles that are alike, as a constant: products with it cost nothing.
struct UnitMass {
  constexpr operator double() const { return 1.0; }
};

}  // namespace clatter
