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
  /// Averages over windows of length `window` (simulation time); their scatter gives the standard
  /// errors. Columns are about one diameter wide, at most 40 columns.
  LiveProfile(Simulation<D>& simulation, double window);
  LiveProfile(const LiveProfile&) = delete;
  LiveProfile& operator=(const LiveProfile&) = delete;

  /// The averages over all complete windows; empty before two windows are complete.
  Profile profile() const;

 private:
  CellIntegrals<D> observer_;
  PartSums sums_;
};

/// Residuals of the balance equations in columns along x.
struct ResidualProfile {
  double width = 0.0;   ///< of a column
  Residuals residuals;  ///< [columns]; empty: no complete window yet
};

/// Closes the balance equations of a running simulation, in the same columns as LiveProfile, since
/// this observer was made.
template <int D>
class LiveResiduals {
 public:
  /// Closes the balances over windows of length `window` (simulation time).
  LiveResiduals(Simulation<D>& simulation, double window);
  LiveResiduals(const LiveResiduals&) = delete;
  LiveResiduals& operator=(const LiveResiduals&) = delete;

  /// The residuals of the complete windows.
  const ResidualProfile& profile() const { return profile_; }

 private:
  Balance<D> observer_;
  ResidualProfile profile_;
};

}  // namespace clatter
