#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// The compared means. Stress and heat flux are the components along the axis from wall to wall,
/// averaged over the box.
enum ComparedMean { kTemperature, kPressure, kStress, kHeatFlux, kDissipation, kComparedMeans };

/// Number of columns of compared profiles. A coarser profile is constant across each of its
/// columns.
inline constexpr int kProfileColumns = 60;
using ProfileValues = std::array<double, kProfileColumns>;

/// Replaces a value that a setting does not have.
inline constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// The results of one run of a setting, and its cost.
struct RunResult {
  double time = 0.0;         ///< simulated time of the averages
  double cpu_seconds = 0.0;  ///< during this time
  double events = 0.0;       ///< collisions with disks and walls during this time
  double bytes = 0.0;        ///< memory of the run
  double collision_rate = 0.0;
  double deepest_overlap = 0.0;  ///< diameters
  /// Share of the collisions of disks that t_c made elastic; NaN: no t_c.
  double elasticised_share = kNotANumber;
  std::array<double, kComparedMeans> means{};  ///< without kHeatFlux, which needs a sign; NaN: none
  ProfileValues density{};                     ///< along the axis
  ProfileValues heat_flux{};                   ///< profile of the heat flux
};

/// Durations of runs.
struct Effort {
  double burn_in = 200.0;    ///< time before the averages
  double duration = 1000.0;  ///< time of the averages
};

/// The axis of profiles: from wall to wall, or x in a periodic box.
Axis compared_axis(const Scene& scene);

/// Runs a scene with the exact engine. Its [measure] gives the cells and the estimator of the
/// fields.
RunResult observe(const Scene& scene, const Effort& effort, std::uint64_t seed);

/// Runs a scene with the time-stepped engine, from a state that the exact engine has prepared.
RunResult observe_stepped(const Scene& scene, double step, const Effort& effort,
                          std::uint64_t seed);

}  // namespace clatter
