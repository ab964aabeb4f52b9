#pragma once

#include <array>

#include "engine/dynamics/simulation.h"
#include "engine/measure/field_maps.h"
#include "engine/measure/profile.h"

namespace clatter {

/// Profiles of a run that goes on, along x, from when it is made: of density, temperature,
/// stress_xx, heat_flux_x and dissipation.
class LiveProfile {
 public:
  /// Watches the simulation in windows of that length of time, whose spread tells standard errors,
  /// in columns of about one diameter, at most 40.
  LiveProfile(Simulation<2>& simulation, double window);
  LiveProfile(const LiveProfile&) = delete;
  LiveProfile& operator=(const LiveProfile&) = delete;

  /// The averages over the windows that are whole; no values before the first two are.
  Profile profile() const;

 private:
  static constexpr std::array<Field, 5> kFields = {
      Field::Density, Field::Temperature, Field::StressXx, Field::HeatFluxX, Field::Dissipation};

  CellIntegrals<2> observer_;
  PartSums sums_;
};

}  // namespace clatter
