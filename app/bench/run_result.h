#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// The means by which settings are compared. Stress and heat flux are those along the axis from
/// wall to wall, averaged over the box.
enum ComparedMean { kTemperature, kPressure, kStress, kHeatFlux, kDissipation, kComparedMeans };

/// Columns that profiles are compared on; coarser ones are taken for constant across each column.
inline constexpr int kProfileColumns = 60;
using ProfileValues = std::array<double, kProfileColumns>;

/// Stands for a value that a setting does not have.
inline constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// What one run of a setting found, and at which cost.
struct RunResult {
  double time = 0.0;         ///< simulated, over which means were taken
  double cpu_seconds = 0.0;  ///< in that time
  double events = 0.0;       ///< collisions with disks and walls, likewise
  double bytes = 0.0;        ///< that the run holds
  double collision_rate = 0.0;
  double deepest_overlap = 0.0;  ///< diameters
  /// Share of the collisions of disks that t_c made elastic; NaN: there is no t_c.
  double elasticised_share = kNotANumber;
  std::array<double, kComparedMeans> means{};  ///< but kHeatFlux, which needs a sign; NaN: none
  ProfileValues density{};                     ///< along the axis
  ProfileValues heat_flux{};                   ///< profile of the heat flux
};

/// How long runs are.
struct Effort {
  double burn_in = 200.0;    ///< time before means are taken
  double duration = 1000.0;  ///< time over which they are
};

/// The axis along which profiles go: from wall to wall, or x in a periodic box.
Axis compared_axis(const Scene& scene);

/// Runs a scene by the exact engine; its [measure] says on which cells and how fields are taken.
RunResult observe(const Scene& scene, const Effort& effort, std::uint64_t seed);

/// Runs it by the time-stepped engine, from a state that the exact one has brought about.
RunResult observe_stepped(const Scene& scene, double step, const Effort& effort,
                          std::uint64_t seed);

}  // namespace clatter
