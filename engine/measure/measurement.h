#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/dynamics/simulation.h"
#include "engine/measure/balance.h"
#include "engine/measure/cell_integrals.h"
#include "engine/measure/compartments.h"
#include "engine/measure/field_maps.h"
#include "engine/measure/fixture_totals.h"
#include "engine/measure/piston_totals.h"
#include "engine/measure/profile.h"
#include "engine/measure/residuals.h"
#include "engine/measure/species_means.h"
#include "engine/measure/species_totals.h"
#include "engine/measure/totals.h"
#include "engine/observables/observables.h"
#include "engine/scene/scene.h"
#include "engine/statistics/estimate.h"
#include "engine/statistics/part_sums.h"
#include "engine/stop_request.h"

namespace clatter {

/// Temperatures at regular times.
struct TemperatureSeries {
  std::vector<double> times;             ///< multiples of series_interval
  std::vector<double> temperature;       ///< T at those times
  std::vector<double> spin_temperature;  ///< T_rot, 0 until something spins; empty without spins
};

/// Visits all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, TemperatureSeries& series) {
  auto& [times, temperature, spin_temperature] = series;
  io(times, temperature, spin_temperature);
}

/// Results of a sheared box (theory 14.2), averaged over time.
struct ShearMeans {
  /// [2][2] stress sigma_ab = -P_ab in the plane of the flow: a is the axis of the separation of
  /// partners, b that of momentum.
  std::array<std::array<Estimate, 2>, 2> stress;
  std::optional<Estimate> viscosity;  ///< sigma_yx over the rate; absent: the rate is 0
};

/// Results of a run, averaged over the time after the burn-in. Results that the scene cannot have
/// are absent.
struct Measured {
  double burn_in = 0.0;               ///< simulation time at which averages start
  double duration = 0.0;              ///< averaging time
  std::uint64_t pair_collisions = 0;  ///< collisions in that time
  std::uint64_t wall_collisions = 0;
  std::uint64_t kicks = 0;                   ///< of bulk driving, each of all particles
  std::uint64_t elasticised = 0;             ///< pair collisions that t_c made elastic
  std::uint64_t elasticised_wall = 0;        ///< collisions with walls that t_c made elastic
  Estimate temperature;                      ///< T
  std::vector<Estimate> axis_temperatures;   ///< [D] T_k
  std::optional<Estimate> spin_temperature;  ///< T_rot = I <omega^2>; absent without spins
  std::vector<Estimate> kurtosis_excess;     ///< [D] <v_k^4>/(3 <v_k^2>^2) - 1
  Estimate collision_rate;  ///< pair collisions per particle and time; each counts for both
  std::optional<Estimate> walls_in;    ///< power of walls, fixtures and the free piston
  std::optional<Estimate> bulk_in;     ///< power of the kicks of bulk driving
  std::optional<Estimate> nudges_in;   ///< power of nudges; absent: none so far
  std::optional<Estimate> gravity_in;  ///< power of gravity
  std::optional<Estimate> shear_in;    ///< power of the shear; absent: the box is not sheared
  std::optional<ShearMeans> shear;     ///< stress and viscosity; absent: the box is not sheared
  Estimate dissipated;                 ///< energy per time lost in pair collisions, > 0
  /// Energy that elasticised pair collisions did not dissipate, divided by the energy that all did:
  /// an estimate of the error due to t_c. Absent without a t_c or without dissipation.
  std::optional<double> undissipated_share;
  double ledger_residual = 0.0;  ///< see Totals::ledger_residual
  /// [2 D] on each Side: momentum per time and length, in 3D per time and area.
  std::vector<std::optional<Estimate>> pressure;
  /// [2D][D] force of the gas per area of each wall along its surface, if a wall slides. The
  /// component along the normal is absent.
  std::vector<std::vector<std::optional<Estimate>>> shear_stress;
  std::optional<Estimate> compressibility;  ///< Z = p/(rho T) from the virial, fully periodic boxes
  std::vector<SpeciesMeans> species;        ///< [S] of a mixture; empty: the particles are alike
  std::vector<PairMeans> pairs;             ///< of the pairs of species of a mixture
  std::vector<FixtureMeans> fixtures;       ///< of the obstacles, then of the partitions
  std::optional<PistonMeans> piston;        ///< of a free piston
  std::optional<CompartmentMeans> compartments;  ///< if a partition or piston divides the gas
  std::optional<Profile> profile;           ///< if averaged fields are requested
  std::optional<Residuals> residuals;       ///< if residuals are requested
  std::optional<FieldMaps> maps;            ///< of all requested fields, over `duration`
  std::vector<FieldMaps> map_series;        ///< of averages, over parts of `duration`, see PartSums
  TemperatureSeries series;                 ///< over the whole run, burn-in included
  std::vector<ObservableResult> observables;  ///< one per requested observable

  /// The tables of all observables; none without averages.
  std::vector<ResultTable> tables() const;
};

/// Upper estimate of the memory of fields and balances in a measurement, in bytes; 0 without
/// fields. `spins`: whether the particles spin. `species`: number of species of a mixture.
template <int D>
double cells_memory(const Measure& measure, bool spins, std::size_t species = 0);

/// Whether averages of a saved run can continue under a model. They cannot under another gravity or
/// wall motion. With fields they cannot if spins appear or change their inertia.
template <int D>
bool averages_go_on(const RunState<D>& saved, bool same_inertia, const Model<D>& model,
                    const Measure& measure);

/// Averages of a continued measurement.
enum class Averages {
  GoOn,    ///< over windows before and after
  Restart  ///< from the burn-in or from now
};

/// Measures a simulation according to the scene's [measure] table. After a change of laws or a puff
/// the series and the energy balance continue. The averages restart as after averages_go_on(), and
/// with other particles.
template <int D>
class Measurement final : private Observer<D> {
 public:
  /// Averages from burn_in, or from now if that is later, to the simulation time `end`.
  Measurement(Simulation<D>& simulation, const Measure& measure, double end);
  /// Continues a measurement from the result of save(): the series, the energy balance and, with
  /// Averages::GoOn, the averages, if the saved ones can continue. The run and the [measure] table
  /// must be the same; a restart needs the same series interval only. Windows keep their length;
  /// averages continue as long as the run.
  Measurement(Simulation<D>& simulation, const Measure& measure, double end, ArchiveReader saved,
              Averages averages = Averages::GoOn);
  Measurement(const Measurement&) = delete;
  Measurement& operator=(const Measurement&) = delete;

  /// The results up to the simulation's time. Throws Interrupted.
  Measured result(const StopRequest& stop = {});
  /// The same over whole windows and without fields. Before the first window ends, means are 0; the
  /// same results are present as in result().
  Measured means() const;

  /// Simulation time at which averages start.
  double averages_start() const { return averages_start_; }
  /// Duration of the windows of averages.
  double window() const { return window_; }

  /// All results up to the simulation's time, for a checkpoint. Averages that end where they begin
  /// cannot continue.
  std::string save();

 private:
  void before_laws(const Model<D>& next) override;
  void on_laws() override;
  void plan_averages();
  void fit_series();
  bool is_overdue() const;
  bool samples_cells() const;
  void observe();
  void sample(double time);
  template <class Archive>
  void visit_series(Archive& io);
  template <class Archive>
  void visit_averages(Archive& io);
  void start();
  void open_sums();
  void close_window();
  void close_balance();
  std::string species_of(Field field) const;
  void add_maps(Measured& measured, const StopRequest& stop) const;

  Simulation<D>& simulation_;
  Measure measure_;            // without residuals among its fields
  double end_;                 // simulation time
  bool balanced_;              // whether residuals are requested
  std::vector<Field> fields_;  // those of measure_, and of each species of a mixture
  Totals<D> totals_;
  std::optional<SpeciesTotals<D>> species_;  // of a mixture
  std::optional<FixtureTotals<D>> fixtures_;  // if there are fixtures
  std::optional<PistonTotals<D>> piston_;     // of a free piston
  std::optional<CellIntegrals<D>> cells_;
  std::optional<Balance<D>> balance_;
  double series_start_ = 0.0;  // simulation times
  double averages_start_ = 0.0;
  double window_ = 0.0;  // duration of each
  bool started_ = false;
  EventCounts counts_at_start_;
  std::vector<WindowTotals<D>> windows_;
  std::vector<SpeciesTotalsWindow<D>> species_windows_;  // [windows] of a mixture
  std::vector<FixtureTotalsWindow<D>> fixture_windows_;  // [windows] with fixtures
  std::vector<PistonWindow> piston_windows_;             // [windows] of a free piston
  std::vector<CellSums> columns_;                        // [windows]
  PartSums<CellSums> parts_;                             // of the windows
  Residuals residuals_;
  std::uint64_t samples_ = 0;  // samples of the snapshot estimator so far
  TemperatureSeries series_;
  CompartmentSeries compartments_;  // at the times of series_; empty: one compartment
  std::optional<Observables<D>> observables_;
  bool go_on_ = true;      // whether the averages continue under the next laws
  std::size_t particles_;  // number of them under the present laws
  Observation<D> own_, of_totals_;
  std::optional<Observation<D>> of_species_, of_fixtures_, of_piston_, of_cells_, of_balance_;
  std::optional<Timers<D>> timers_;
};

extern template double cells_memory<2>(const Measure&, bool, std::size_t);
extern template double cells_memory<3>(const Measure&, bool, std::size_t);
extern template bool averages_go_on<2>(const RunState<2>&, bool, const Model<2>&, const Measure&);
extern template bool averages_go_on<3>(const RunState<3>&, bool, const Model<3>&, const Measure&);
extern template class Measurement<2>;
extern template class Measurement<3>;

}  // namespace clatter
