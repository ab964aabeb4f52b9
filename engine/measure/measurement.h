#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/dynamics/simulation.h"
#include "engine/measure/balance.h"
#include "engine/measure/cell_integrals.h"
#include "engine/measure/estimate.h"
#include "engine/measure/field_maps.h"
#include "engine/measure/profile.h"
#include "engine/measure/residuals.h"
#include "engine/measure/totals.h"
#include "engine/scene/scene.h"

namespace clatter {

/// What a run measured, over the time after the burn-in. Parts that the scene does not have are
/// absent.
struct Measured {
  double burn_in = 0.0;               ///< simulation time at which averages start
  double duration = 0.0;              ///< time averaged over
  std::uint64_t pair_collisions = 0;  ///< collisions in that time
  std::uint64_t wall_collisions = 0;
  std::uint64_t kicks = 0;                   ///< of bulk driving, each of all particles
  std::uint64_t elasticised = 0;             ///< disk-disk collisions that t_c made elastic
  std::uint64_t elasticised_wall = 0;        ///< collisions with walls that t_c made elastic
  Estimate temperature;                      ///< T
  std::vector<Estimate> axis_temperatures;   ///< [D] T_k
  std::optional<Estimate> spin_temperature;  ///< T_rot = I <omega^2>, where spins are carried
  std::vector<Estimate> kurtosis_excess;     ///< [D] <v_k^4>/(3 <v_k^2>^2) - 1
  Estimate collision_rate;  ///< disk-disk collisions per particle and time; each counts for both
  std::optional<Estimate> walls_in;    ///< energy per time that the walls give
  std::optional<Estimate> bulk_in;     ///< likewise the kicks of bulk driving
  std::optional<Estimate> gravity_in;  ///< likewise gravity
  Estimate dissipated;                 ///< energy per time lost in disk-disk collisions, > 0
  /// What elasticised collisions of particles did not dissipate, over what all did: an estimate of
  /// the error that t_c makes. Where there is a t_c and something dissipates.
  std::optional<double> undissipated_share;
  double ledger_residual = 0.0;  ///< see Totals::ledger_residual
  /// [2 D] on each Side: momentum per time and length, in space per time and area.
  std::vector<std::optional<Estimate>> pressure;
  std::optional<Estimate> compressibility;  ///< Z = p/(rho T) from the virial, fully periodic boxes
  std::optional<Profile> profile;           ///< where fields are asked for that are averages
  std::optional<Residuals> residuals;       ///< where residuals are asked for
  std::optional<FieldMaps> maps;            ///< of all that is asked for, over `duration`
  std::vector<FieldMaps> map_series;        ///< of averages, in the parts of it, see PartSums
  std::vector<double> series_time;          ///< 0, series_interval, ...; burn-in included
  std::vector<double> series_temperature;   ///< T at those times
  std::vector<double> series_spin_temperature;  ///< T_rot; empty where no spins are carried
};

/// Memory that the cells of fields and balances take in a measurement, about and at most, in bytes;
/// `spins`: whether the particles spin. 0 where no fields are asked for.
template <int D>
double cells_memory(const Measure& measure, bool spins);

/// Observes a simulation as the scene's [measure] block asks.
template <int D>
class Measurement {
 public:
  /// Averages from burn_in to `end`, simulation times; watches from now on, where that is later.
  Measurement(Simulation<D>& simulation, const Measure& measure, double end);
  /// Goes on from what save() told of another measurement of the same run, asked for by the same
  /// block: averages over windows of the same length, for as long as the run goes on.
  Measurement(Simulation<D>& simulation, const Measure& measure, ArchiveReader saved);

  /// What has been measured up to the simulation's time.
  Measured result();
  /// Likewise, in whole windows and without fields; before the first window has passed means are 0,
  /// and there are those that result() will have.
  Measured means() const;

  /// Simulation time at which averages start.
  double averages_start() const { return averages_start_; }
  /// Duration of the windows of time that averages consist of.
  double window() const { return window_; }

  /// All that has been measured up to the simulation's time, for a checkpoint.
  std::string save();

 private:
  void observe();
  void sample(double time);
  template <class Archive>
  void visit(Archive& io);
  void start();
  void open_cells();
  void observe_cells();
  void close_window();
  void close_balance();
  void add_maps(Measured& measured) const;

  Simulation<D>& simulation_;
  Measure measure_;  // its fields without residuals
  bool balanced_;    // whether residuals are asked for
  Totals<D> totals_;
  std::optional<CellIntegrals<D>> cells_;
  std::optional<Balance<D>> balance_;
  double series_start_ = 0.0;  // simulation times
  double averages_start_ = 0.0;
  double window_ = 0.0;  // duration of each
  bool started_ = false;
  EventCounts counts_at_start_;
  std::vector<WindowTotals<D>> windows_;
  std::vector<CellSums> columns_;  // [windows]
  PartSums parts_;                 // of the windows
  Residuals residuals_;
  std::uint64_t samples_ = 0;  // that the snapshot estimator has taken
  std::vector<double> series_time_;
  std::vector<double> series_temperature_;
  std::vector<double> series_spin_temperature_;
};

extern template double cells_memory<2>(const Measure&, bool);
extern template double cells_memory<3>(const Measure&, bool);
extern template class Measurement<2>;
extern template class Measurement<3>;

}  // namespace clatter
