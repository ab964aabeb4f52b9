#pragma once

#include <cstdint>

namespace clatter {

/// Quantities that a run measures besides means and fields.
enum class ObservableKind : std::uint8_t {
  RadialDistribution,       ///< g(r)
  VelocityDistribution,     ///< of the components, and Sonine coefficients
  FreeFlights,              ///< times and lengths of paths between collisions of particles
  Collisions,               ///< impact parameters, impact speeds and energy losses
  WallHits,                 ///< normal speeds before and after, and energy gains
  MeanSquaredDisplacement,  ///< of unwrapped positions
  VelocityAutocorrelation,  ///< <v_k(0) v_k(t)>
  StructureFactor,          ///< S(k)
  Clusters,                 ///< sizes of clusters, and their growth
  BondOrder                 ///< psi_6 of disks and its correlation in time
};

/// Settings of g(r).
struct RadialDistributionSettings {
  double interval = 1.0;  ///< time between samples, > 0
  double range = 5.0;     ///< largest distance, above a diameter; shorter in small boxes
  int bins = 200;         ///< between contact and the range
};

/// Settings of the distribution of velocities.
struct VelocityDistributionSettings {
  double interval = 1.0;  ///< time between samples, > 0
  double range = 6.0;     ///< largest component, in units of the thermal speed sqrt(T/m)
  int bins = 120;         ///< over both signs
};

/// Settings of a correlation in time. The lags are 1, 2, ... `lags` intervals. Then come the same
/// multiples of `lags` intervals, and so on, up to the longest.
struct TimeCorrelationSettings {
  double interval = 0.1;  ///< shortest lag, > 0
  double longest = 10.0;  ///< longest lag, >= interval
  int lags = 10;          ///< number of lags of equal spacing, >= 2
};

/// Settings of S(k).
struct StructureFactorSettings {
  double interval = 10.0;  ///< time between samples, > 0
  double range = 15.0;     ///< largest wave number
  int bins = 60;           ///< number of shells
  int vectors = 8;         ///< largest number of wave vectors in a shell
};

/// Settings of clusters.
struct ClusterSettings {
  double interval = 1.0;  ///< time between samples, > 0
  double range = 1.2;     ///< largest distance of connected particles, above a diameter
};

/// Settings of the bond order.
struct BondOrderSettings {
  TimeCorrelationSettings lags_in_time = {.interval = 1.0, .longest = 100.0};
  double range = 1.5;  ///< largest distance of neighbours, above a diameter
};

}  // namespace clatter
