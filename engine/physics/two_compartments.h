#pragma once

namespace clatter {

/// Disks in two equal compartments over a driven floor, with an opening above it
/// (theory 13.5-13.7). The gas of each is dilute, and has one temperature. Masses and diameters
/// are 1.
struct TwoCompartments {
  double count = 0.0;              ///< N of both
  double width = 1.0;              ///< of each compartment
  double restitution = 1.0;        ///< of the disks, < 1
  double drive_speed = 1.0;        ///< v_dr > 0 of the floor
  double floor_restitution = 1.0;  ///< of the floor, 0..1
  double gravity = 1.0;            ///< g > 0
  double height = 1.0;             ///< of the lower edge of the opening

  /// Share of the particles in the fuller compartment of the stable state: 1/2, or more where an
  /// equal split is unstable.
  double fuller_share() const;
  /// Flux through the opening from a compartment, relative, by its Y = (1 - alpha^2) N_k / W.
  double flux(double filling) const;
};

}  // namespace clatter
