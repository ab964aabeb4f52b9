#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/scene/view.h"

namespace clatter {

/// Quantities that a run measures besides means and fields.
enum class ObservableKind : std::uint8_t {
  RadialDistribution,         ///< g(r)
  VelocityDistribution,       ///< of the components, and Sonine coefficients
  FreeFlights,                ///< times and lengths of paths between collisions of particles
  Collisions,                 ///< impact parameters, impact speeds and energy losses
  WallHits,                   ///< normal speeds before and after, and energy gains
  MeanSquaredDisplacement,    ///< of unwrapped positions
  VelocityAutocorrelation,    ///< <v_k(0) v_k(t)>
  StructureFactor,            ///< S(k)
  Clusters,                   ///< sizes of clusters, and their growth
  BondOrder,                  ///< psi_6 of disks and its correlation in time
  WallPower,                  ///< distribution of the power of the walls
  PlaneCurrent,               ///< net number of particles that cross a plane
  LocalDensity,               ///< number of particles in cells
  SpinDistribution,           ///< of the components, and angles between spin and velocity
  Probe,                      ///< density, temperature and velocity in a region over time
  CollisionCounts,            ///< of each particle and of pairs in intervals
  RadialDistributionProfile,  ///< g(r) in slabs along an axis
  Mixing                      ///< how well the species of a mixture are mixed
};

/// The observable whose table a plot shows; absent: none.
constexpr std::optional<ObservableKind> observable_of(FilmPlot plot) {
  if (plot == FilmPlot::MeanSquaredDisplacement) return ObservableKind::MeanSquaredDisplacement;
  if (plot == FilmPlot::VelocityAutocorrelation) return ObservableKind::VelocityAutocorrelation;
  return std::nullopt;
}

/// Settings of g(r).
struct RadialDistributionSettings {
  double interval = 1.0;  ///< time between samples, > 0
  double range = 5.0;     ///< largest distance, above a diameter; shorter in small boxes
  int bins = 200;         ///< between contact and the range
};

/// A region with edges along the axes. An edge at a side of the box includes all centres beyond it.
struct RegionSettings {
  std::optional<VecX> lower = {};  ///< [D] corner within the box; absent: see the observable
  std::optional<VecX> upper = {};  ///< [D] opposite corner, above `lower`; absent: as for `lower`
};

/// Settings of the distribution of velocities.
struct VelocityDistributionSettings {
  double interval = 1.0;       ///< time between samples, > 0
  double range = 6.0;          ///< largest component, in units of the thermal speed
  int bins = 120;              ///< over both signs
  RegionSettings region = {};  ///< of the particles; absent corners: those of the box
};

/// Settings of the distribution of spins.
struct DistributionSettings {
  double interval = 1.0;  ///< time between samples, > 0
  double range = 6.0;     ///< largest component, in units of the root mean square
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

/// Settings of the power of the walls.
struct WallPowerSettings {
  double interval = 1.0;  ///< time over which the power is averaged, > 0
};

/// Settings of the current through a plane.
struct PlaneCurrentSettings {
  double interval = 1.0;  ///< time over which crossings are counted, > 0
  Axis axis = Axis::X;    ///< normal of the plane
  double position = 0.5;  ///< of the plane, as a share of the box along its normal
};

/// Settings of the probe.
struct ProbeSettings {
  double interval = 1.0;       ///< time between samples, > 0
  RegionSettings region = {};  ///< absent corners: at 1/4 and 3/4 of each side of the box
};

/// Settings of the numbers of collisions.
struct CollisionCountSettings {
  double interval = 10.0;  ///< time over which collisions are counted, > 0
};

/// Settings of g(r) in slabs along an axis.
struct RadialProfileSettings {
  double interval = 1.0;  ///< time between samples, > 0
  double range = 3.0;     ///< largest distance, above a diameter; shorter in small boxes
  int bins = 40;          ///< between contact and the range
  Axis axis = Axis::X;    ///< normal of the slabs
  int slabs = 10;         ///< number of equal slabs of the region of centres
};

/// Settings of the numbers of particles in cells.
struct CellSettings {
  double interval = 1.0;  ///< time between samples, > 0
  double cell = 3.0;      ///< shortest edge of the cells, > 0

  /// Number of equal cells along a side of the box: the most with this edge, at least 1.
  double cells_along(double side) const { return std::max(1.0, std::floor(side / cell)); }
  /// Number of cells in a box.
  double number_of_cells(const VecX& box) const {
    double number = 1.0;
    for (const double side : box) number *= cells_along(side);
    return number;
  }
};

}  // namespace clatter
