#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/statistics/estimate.h"

namespace clatter {

/// The plane that divides the gas into two compartments now: the free piston, or the first
/// partition at right angles to an axis with walls; absent: none does.
template <int D>
std::optional<AxisPlane> compartment_plane(const Simulation<D>& simulation);

/// The compartments at regular times. A particle belongs to the one that has its centre.
struct CompartmentSeries {
  std::vector<double> position;           ///< of the plane that divides them
  std::vector<double> share_left;         ///< share of the particles at the lower side
  std::vector<double> temperature_left;   ///< (1/D N) sum m v^2 of the particles there; NaN: none
  std::vector<double> temperature_right;  ///< the same of the others

  /// Adds the state of a simulation now, as sample number `number`. Former ones without
  /// compartments are NaN.
  template <int D>
  void sample(const Simulation<D>& simulation, const AxisPlane& plane, std::size_t number);
};

/// Visits all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, CompartmentSeries& series) {
  auto& [position, share_left, temperature_left, temperature_right] = series;
  io(position, share_left, temperature_left, temperature_right);
}

/// Results of the compartments, averaged over samples. Temperatures are over the samples in which
/// the compartment has particles, and absent without any.
struct CompartmentMeans {
  Estimate count_left;  ///< number of particles at the lower side
  Estimate share_left;  ///< this number over that of all
  Estimate imbalance;   ///< |N_left - N_right| / N
  /// Probability density of share_left in bins of equal width from 0 to 1.
  std::vector<Estimate> distribution;
  std::optional<Estimate> temperature_left;
  std::optional<Estimate> temperature_right;
  std::vector<double> share_left_series;  ///< at all samples, the burn-in included
  std::vector<double> position_series;    ///< of the plane that divides them, at the same samples
};

/// The means of the samples from number `first` on, of a gas of `count` particles.
CompartmentMeans compartment_means(const CompartmentSeries& series, std::size_t first,
                                   double count);

}  // namespace clatter
