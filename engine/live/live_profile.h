#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/dynamics/simulation.h"
#include "engine/measure/balance.h"
#include "engine/measure/field_maps.h"
#include "engine/measure/profile.h"
#include "engine/measure/residuals.h"
#include "engine/statistics/part_sums.h"

namespace clatter {

/// The fields of a LiveProfile along an axis, in their order.
constexpr std::array<Field, 5> profiled_fields(Axis axis) {
  const int k = static_cast<int>(axis);
  return {Quantity::Density, Quantity::Temperature, Field(Quantity::Stress, k, k),
          Field(Quantity::HeatFlux, k), Quantity::Dissipation};
}

/// The same fields, and for each of this number of species its density and its temperature.
std::vector<Field> profiled_fields(Axis axis, std::size_t species);

/// Profiles of profiled_fields() along an axis of a running simulation, averaged since this
/// observer was made.
template <int D>
class LiveProfile {
 public:
  /// Averages over windows of length `window` (simulation time); their scatter gives the standard
  /// errors. Columns are about one mean diameter wide, at most 40 columns.
  LiveProfile(Simulation<D>& simulation, double window, Axis axis);
  /// Continues a saved profile. The simulation must be at the same time under the same laws.
  LiveProfile(Simulation<D>& simulation, double window, Axis axis, ArchiveReader& saved);
  LiveProfile(const LiveProfile&) = delete;
  LiveProfile& operator=(const LiveProfile&) = delete;

  /// The averages over all complete windows; empty before two windows are complete.
  Profile profile() const;

  /// Visits the members that a checkpoint keeps.
  template <class Archive>
  void visit(Archive& io) {
    auto& [axis, fields, start, closed, observer, sums, observation, timers] = *this;
    io(start, closed, observer, sums);
  }

 private:
  void watch(double window);

  Axis axis_;
  std::vector<Field> fields_;
  double start_;              // simulation time at which the first window closes
  std::uint64_t closed_ = 0;  // windows closed since then
  CellIntegrals<D> observer_;
  PartSums<CellSums> sums_;
  Observation<D> observation_;
  Timers<D> timers_;
};

/// Residuals of the balance equations in columns along an axis.
struct ResidualProfile {
  double width = 0.0;   ///< of a column
  Residuals residuals;  ///< [columns]; empty: no complete window yet
  Axis axis = Axis::X;
};

/// Closes the balance equations of a running simulation, in the same columns as LiveProfile, since
/// this observer was made.
template <int D>
class LiveResiduals {
 public:
  /// Closes the balances over windows of length `window` (simulation time).
  LiveResiduals(Simulation<D>& simulation, double window, Axis axis);
  LiveResiduals(const LiveResiduals&) = delete;
  LiveResiduals& operator=(const LiveResiduals&) = delete;

  /// The residuals of the complete windows.
  const ResidualProfile& profile() const { return profile_; }

 private:
  Balance<D> observer_;
  ResidualProfile profile_;
  Observation<D> observation_;
  Timers<D> timers_;
};

}  // namespace clatter
