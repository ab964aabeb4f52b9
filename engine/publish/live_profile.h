#pragma once

#include <array>

#include "engine/dynamics/simulation.h"
#include "engine/measure/balance.h"
#include "engine/measure/field_maps.h"
#include "engine/measure/profile.h"
#include "engine/measure/residuals.h"

namespace clatter {

/// The fields of a LiveProfile, in their order.
inline constexpr std::array<Field, 5> kProfiledFields = {
    Quantity::Density, Quantity::Temperature, Field(Quantity::Stress, 0, 0),
    Field(Quantity::HeatFlux, 0), Quantity::Dissipation};

/// Profiles along x of a running simulation, averaged since this observer was made.
template <int D>
class LiveProfile {
 public:
  /// Watches the simulation in windows of that length of time, whose spread tells standard errors,
  /// in columns of about one diameter, at most 40.
  LiveProfile(Simulation<D>& simulation, double window);
  LiveProfile(const LiveProfile&) = delete;
  LiveProfile& operator=(const LiveProfile&) = delete;

  /// The averages over the windows that are whole; no values before the first two are.
  Profile profile() const;

 private:
  CellIntegrals<D> observer_;
  PartSums sums_;
};

/// How the balance equations close in columns along x.
struct ResidualProfile {
  double width = 0.0;   ///< of a column
  Residuals residuals;  ///< [columns]; empty: no window is whole yet
};

/// Closes the balance equations of a run that goes on in the columns of its LiveProfile, from when
/// it is made.
template <int D>
class LiveResiduals {
 public:
  /// Watches the simulation in windows of that length of time.
  LiveResiduals(Simulation<D>& simulation, double window);
  LiveResiduals(const LiveResiduals&) = delete;
  LiveResiduals& operator=(const LiveResiduals&) = delete;

  /// The residuals of the windows that are whole.
  const ResidualProfile& profile() const { return profile_; }

 private:
  Balance<D> observer_;
  ResidualProfile profile_;
};

}  // namespace clatter
