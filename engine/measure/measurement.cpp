#include "engine/measure/measurement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter {

// Number of windows: enough for blocking to resolve correlations, and more for a finer series.
static constexpr double kMinWindows = 512.0;
static constexpr double kMaxWindows = 8192.0;
// Balances are closed over longer windows. In a short time a weak gravity books so little that the
// rounding of the particles' energies would dominate.
static constexpr std::size_t kWindowsPerBalance = 32;

std::vector<ResultTable> Measured::tables() const {
  std::vector<ResultTable> tables;
  if (!(duration > 0.0)) return tables;
  for (const ObservableResult& observable : observables) {
    tables.insert(tables.end(), observable.tables.begin(), observable.tables.end());
  }
  return tables;
}

static double windows_in(double span, double series_interval) {
  return std::clamp(std::ceil(span / series_interval), kMinWindows, kMaxWindows);
}

// The first time of a series at or after a time.
static double series_start(double interval, double time) {
  const RegularTimes times(interval);
  return times.of(times.first_from(time));
}

template <int D>
static IntVec<D> cells_of(const Measure& measure) {
  return Eigen::Map<const IntVec<D>>(measure.cells.data());
}

// The fields of all particles, and then those of each species.
static std::vector<Field> with_species(std::vector<Field> fields, std::size_t species) {
  const std::vector<Field> all = fields;
  std::erase_if(fields, [](Field field) { return of_species_alone(field.quantity); });
  for (std::size_t s = 0; s < species; ++s) {
    for (const Field field : all) {
      if (has_species(field.quantity)) fields.push_back(field.of(s));
    }
  }
  return fields;
}

template <int D>
static std::size_t species_in(const Simulation<D>& simulation) {
  const auto& species = simulation.model().species;
  return species ? species->count() : 0;
}

template <int D>
double cells_memory(const Measure& measure, bool spins, std::size_t species) {
  std::vector<Field> averages = measure.fields;
  const bool balanced = std::erase_if(averages, is_residual) > 0;
  averages = with_species(averages, species);
  const double cells = cells_of<D>(measure).template cast<double>().prod();
  double bytes = 0.0;
  if (!averages.empty()) {
    const double row = moment_layout<D>(averages, spins, species > 0).size * sizeof(double);
    const auto parts =
        static_cast<double>(PartSums<CellSums>::max_parts(static_cast<std::size_t>(cells * row)));
    const double maps = (parts + 1.0) * static_cast<double>(averages.size() * sizeof(double));
    const int columns = measure.cells[static_cast<std::size_t>(measure.profile_axis)];
    // Besides the parts: the current window, and the closed window or the sum of the parts.
    bytes += cells * ((parts + 2.0) * row + maps) +
             windows_in(measure.duration, measure.series_interval) * columns * row;
  }
  if (balanced) {
    // The current and the closed window.
    constexpr std::size_t kBookings = (D + 1) * sizeof(Booked<D>) + sizeof(Conserved<D>);
    constexpr std::size_t kResidual = 4 * (D + 2) * sizeof(double);
    const std::size_t numbers = 2 * (D + 1) * sizeof(double) * species;
    bytes += cells * static_cast<double>(2 * kBookings + kResidual + numbers);
  }
  return bytes;
}

template <int D>
Measurement<D>::Measurement(Simulation<D>& simulation, const Measure& measure, double end)
    : simulation_(simulation),
      measure_(measure),
      end_(end),
      balanced_(std::erase_if(measure_.fields, is_residual) > 0),
      fields_(with_species(measure_.fields, species_in(simulation))),
      totals_(simulation),
      series_start_(series_start(measure.series_interval, simulation.time())),
      particles_(simulation.particles().size()),
      own_(simulation, *this),
      of_totals_(simulation, totals_) {
  plan_averages();
  observe();
}

template <int D>
Measurement<D>::Measurement(Simulation<D>& simulation, const Measure& measure, double end,
                            ArchiveReader saved, Averages averages)
    : simulation_(simulation),
      measure_(measure),
      end_(end),
      balanced_(std::erase_if(measure_.fields, is_residual) > 0),
      fields_(with_species(measure_.fields, species_in(simulation))),
      totals_(simulation),
      particles_(simulation.particles().size()),
      own_(simulation, *this),
      of_totals_(simulation, totals_) {
  plan_averages();
  bool continues = false;
  visit_series(saved);
  saved(continues);
  if (continues && averages == Averages::GoOn) {
    visit_averages(saved);
    if (started_) observables_->restore(saved, averages_start_);
    saved.finish();
    saved.require(window_ > 0.0);
  }
  saved.require(!is_overdue());
  observe();
}

// Plans averages without windows.
template <int D>
void Measurement<D>::plan_averages() {
  averages_start_ = std::max(measure_.burn_in, simulation_.time());
  const double span = std::max(0.0, end_ - averages_start_);
  window_ = span / windows_in(span, measure_.series_interval);
  started_ = false;
  windows_.clear();
  species_windows_.clear();
  fixture_windows_.clear();
  piston_windows_.clear();
  columns_.clear();
  parts_ = {};
  residuals_ = {};
  samples_ = 0;
  of_species_.reset();
  of_fixtures_.reset();
  of_piston_.reset();
  of_cells_.reset();
  of_balance_.reset();
  species_.reset();
  fixtures_.reset();
  piston_.reset();
  cells_.reset();
  balance_.reset();
  observables_.emplace(simulation_, measure_);
}

// A flight is booked at its end, with the gravity of that time. With other spins the fields need
// other sums, and the energy of cells changes.
template <int D>
bool averages_go_on(const RunState<D>& saved, bool same_inertia, const Model<D>& model,
                    const Measure& measure) {
  const bool same_spins =
      saved.flights.empty() || (saved.spins.empty() != model.spins && same_inertia);
  return (measure.fields.empty() || same_spins) && keeps_flights<D>(saved, model);
}

template <int D>
void Measurement<D>::before_laws(const Model<D>& next) {
  const Model<D>& present = simulation_.model();
  const bool same_spins =
      particles_ == 0 || (present.spins == next.spins && present.inertia == next.inertia);
  const bool same_sums = same_spins || (measure_.fields.empty() && !balanced_);
  go_on_ = same_sums && keeps_flights<D>(present, next);
}

template <int D>
void Measurement<D>::on_laws() {
  fit_series();
  const bool same_particles = particles_ == simulation_.particles().size();
  particles_ = simulation_.particles().size();
  if (go_on_ && same_particles) return;
  plan_averages();
  observe();
}

// Whether a sample or the end of a window should have been long ago.
template <int D>
bool Measurement<D>::is_overdue() const {
  return simulation_.is_overdue(averages_start_, window_, started_ ? windows_.size() + 1 : 0) ||
         simulation_.is_overdue(series_start_, measure_.series_interval, series_.times.size()) ||
         (samples_cells() &&
          simulation_.is_overdue(averages_start_ + measure_.interval, measure_.interval, samples_));
}

// Whether averages of fields come from samples.
template <int D>
bool Measurement<D>::samples_cells() const {
  return measure_.estimator == Estimator::Snapshot && !measure_.fields.empty();
}

template <int D>
std::string Measurement<D>::save() {
  bool continues = window_ > 0.0;
  ArchiveWriter writer;
  visit_series(writer);
  writer(continues);
  if (!continues) return writer.written();
  visit_averages(writer);
  if (started_) observables_->save(writer);
  return writer.written();
}

template <int D>
template <class Archive>
void Measurement<D>::visit_series(Archive& io) {
  io(totals_, series_start_, series_, compartments_);
  fit_series();
}

// A change of laws may have added spins.
template <int D>
void Measurement<D>::fit_series() {
  if (!simulation_.spins().empty()) series_.spin_temperature.resize(series_.times.size());
}

// With visit_series(), all members that a checkpoint keeps.
template <int D>
template <class Archive>
void Measurement<D>::visit_averages(Archive& io) {
  auto& [simulation, measure, end, balanced, fields, totals, species, fixtures, piston, cells,
         balance, series_start, averages_start, window, started, counts_at_start, windows,
         species_windows, fixture_windows, piston_windows, columns, parts, residuals, samples,
         series, compartments, observables, go_on, particles, own, of_totals, of_species,
         of_fixtures, of_piston, of_cells, of_balance, timers] = *this;
  io(averages_start, window, started, counts_at_start, windows, columns, parts, residuals, samples);
  if (simulation.model().species) io(species_windows);
  if (!simulation.model().fixtures.empty()) io(fixture_windows);
  if (simulation.model().free_piston) io(piston_windows);
  if (started && !species && !fixtures && !piston && !cells && !balance) open_sums();
  if (species) io(*species);
  if (fixtures) io(*fixtures);
  if (piston) io(*piston);
  if (cells) io(*cells);
  if (balance) io(*balance);
}

// Timers of samples come before timers of windows, so that a sample at a window's end belongs to
// it.
template <int D>
void Measurement<D>::observe() {
  timers_.reset();  // of former averages
  timers_.emplace(simulation_);
  timers_->every(
      series_start_, measure_.series_interval, [this](double time) { sample(time); },
      series_.times.size());
  if (samples_cells()) {
    timers_->every(
        averages_start_ + measure_.interval, measure_.interval,
        [this](double) {
          ++samples_;
          cells_->sample();
        },
        samples_);
  }
  observables_->add_timers(*timers_, averages_start_);
  timers_->every(
      averages_start_, window_, [this](double) { started_ ? close_window() : start(); },
      started_ ? windows_.size() + 1 : 0);
}

template <int D>
void Measurement<D>::sample(double time) {
  const auto count = static_cast<double>(simulation_.particles().size());
  series_.times.push_back(time);
  const auto per_component = [&](double energy, int components) {
    return count > 0.0 ? 2.0 * energy / (components * count) : 0.0;
  };
  series_.temperature.push_back(per_component(simulation_.kinetic_energy(), D));
  if (!simulation_.spins().empty()) {
    series_.spin_temperature.push_back(per_component(simulation_.spin_energy(), kSpinSize<D>));
  }
  if (const auto plane = compartment_plane(simulation_)) {
    compartments_.sample(simulation_, *plane, series_.times.size() - 1);
  }
}

template <int D>
void Measurement<D>::start() {
  started_ = true;
  totals_.close_window();
  counts_at_start_ = simulation_.counts();
  open_sums();
  observables_->start();
}

template <int D>
void Measurement<D>::open_sums() {
  if (simulation_.model().species) {
    of_species_.emplace(simulation_, species_.emplace(simulation_));
  }
  if (!simulation_.model().fixtures.empty()) {
    of_fixtures_.emplace(simulation_, fixtures_.emplace(simulation_));
  }
  if (simulation_.model().free_piston) {
    of_piston_.emplace(simulation_, piston_.emplace(simulation_));
  }
  const IntVec<D> cells = cells_of<D>(measure_);
  if (balanced_) of_balance_.emplace(simulation_, balance_.emplace(simulation_, cells));
  if (measure_.fields.empty()) return;
  Coarsening coarsening{measure_.estimator, {}};
  if (measure_.kernel == Kernel::Gaussian) coarsening.gaussian_width = measure_.width;
  of_cells_.emplace(simulation_, cells_.emplace(simulation_, cells,
                                                moment_layout<D>(fields_, simulation_.model().spins,
                                                                 simulation_.is_mixture()),
                                                coarsening));
}

template <int D>
void Measurement<D>::close_window() {
  windows_.push_back(totals_.close_window());
  if (species_) species_windows_.push_back(species_->close_window());
  if (fixtures_) fixture_windows_.push_back(fixtures_->close_window());
  if (piston_) piston_windows_.push_back(piston_->close_window());
  observables_->close_window();
  if (cells_) {
    CellSums window = cells_->close_window();
    columns_.push_back(columns_of(window, cells_->grid(), measure_.profile_axis));
    parts_.add(std::move(window));
  }
  if (balance_ && windows_.size() % kWindowsPerBalance == 0) close_balance();
}

template <int D>
void Measurement<D>::close_balance() {
  const BalanceWindow<D> window = balance_->close_window();
  residuals_.include(window.imbalances);
  residuals_.include_numbers(window.number_residuals, species_in(simulation_));
}

// Name of the species of a field; empty: it is of all particles.
template <int D>
std::string Measurement<D>::species_of(Field field) const {
  if (field.species == Field::kNone) return {};
  return simulation_.model().species->name(static_cast<std::size_t>(field.species));
}

template <int D>
void Measurement<D>::add_maps(Measured& measured, const StopRequest& stop) const {
  const FieldGrid<D> grid(simulation_.model(), cells_of<D>(measure_));
  const auto maps_of = [&](const CellSums& sums, double begin, double end) {
    FieldMaps maps{begin, end, {grid.widths().begin(), grid.widths().end()}, {}};
    maps.maps = field_maps<D>(fields_, sums, grid, cells_->layout(), stop);
    for (FieldMap& map : maps.maps) map.species = species_of(map.field);
    return maps;
  };
  const auto time_of = [&](std::uint64_t windows) {
    return averages_start_ +
           static_cast<double>(std::min<std::uint64_t>(windows, windows_.size())) * window_;
  };
  CellSums sum;
  std::uint64_t windows = 0;
  for (const CellSums& part : parts_.parts()) {
    const double begin = time_of(windows);
    windows += parts_.windows_per_part();
    measured.map_series.push_back(maps_of(part, begin, time_of(windows)));
    sum += part;
  }
  measured.maps = maps_of(sum, averages_start_, time_of(windows_.size()));
  if (!balanced_) return;
  for (const Field field : residual_fields(D)) {
    const IntVec<D>& cells = grid.cells();
    measured.maps->maps.push_back({field, {cells.begin(), cells.end()}, residuals_.map(field)});
  }
}

// The series of a quantity over the windows.
template <typename Window, typename Quantity>
static std::vector<double> series_of(const std::vector<Window>& windows, const Quantity& quantity) {
  std::vector<double> series;
  series.reserve(windows.size());
  for (const Window& window : windows) series.push_back(quantity(window));
  return series;
}

template <int D>
static Estimate kurtosis_excess(const std::vector<WindowTotals<D>>& windows, int axis) {
  const auto second = series_of(windows, [&](const auto& w) { return w.second_moment[axis]; });
  auto fourth = series_of(windows, [&](const auto& w) { return w.fourth_moment[axis]; });
  const double m2 = mean_estimate(second).mean;
  const double m4 = mean_estimate(fourth).mean;
  // A product of very slow velocities is 0, and has no ratio.
  if (!std::isnormal(m2 * m2 * m2)) return {};
  // Linearised about the means: d(m4/m2^2) = dm4/m2^2 - 2 m4 dm2/m2^3.
  for (std::size_t k = 0; k < fourth.size(); ++k) {
    fourth[k] = (fourth[k] / (m2 * m2) - 2.0 * m4 * second[k] / (m2 * m2 * m2)) / 3.0;
  }
  return linear_estimate(m4 / (3.0 * m2 * m2) - 1.0, fourth);
}

// [S] numbers of the particles of each species.
template <int D>
static std::vector<std::size_t> species_counts(const Simulation<D>& simulation) {
  std::vector<std::size_t> counts(simulation.model().species->count());
  for (std::uint32_t i = 0; i < simulation.particles().size(); ++i) {
    ++counts[simulation.grain(i).species];
  }
  return counts;
}

template <int D>
Measured Measurement<D>::means() const {
  const Model<D>& model = simulation_.model();
  const auto count = static_cast<double>(simulation_.particles().size());
  Measured measured;
  measured.burn_in = averages_start_;
  measured.series = series_;
  measured.ledger_residual = totals_.ledger_residual();
  measured.axis_temperatures.resize(D);
  measured.kurtosis_excess.resize(D);
  measured.pressure.resize(2 * D);
  measured.observables = observables_->results();
  if (count == 0.0) return measured;
  const auto estimate = [&](const auto& quantity) {
    return mean_estimate(series_of(windows_, quantity));
  };
  measured.duration = static_cast<double>(windows_.size()) * window_;
  const EventCounts& counts = simulation_.counts();
  const EventCounts& at_start = started_ ? counts_at_start_ : counts;
  measured.pair_collisions = counts.pair_collisions - at_start.pair_collisions;
  measured.wall_collisions = counts.wall_collisions - at_start.wall_collisions;
  measured.kicks = counts.kicks - at_start.kicks;
  measured.elasticised = counts.elasticised - at_start.elasticised;
  measured.elasticised_wall = counts.elasticised_wall - at_start.elasticised_wall;
  measured.temperature = estimate([](const auto& w) { return w.temperature.mean(); });
  for (int axis = 0; axis < D; ++axis) {
    measured.axis_temperatures[axis] = estimate([&](const auto& w) { return w.temperature[axis]; });
    measured.kurtosis_excess[axis] = kurtosis_excess(windows_, axis);
  }
  if (model.spins) {
    measured.spin_temperature = estimate([](const auto& w) { return w.spin_temperature; });
  }
  measured.collision_rate =
      estimate([&](const auto& w) { return 2.0 * w.collisions / (count * w.duration); });
  measured.dissipated = estimate([](const auto& w) { return w.dissipated / w.duration; });
  // Laws that have ended may have acted in some windows.
  const auto occurred = [&](const auto& quantity) {
    return std::ranges::any_of(windows_, [&](const auto& w) { return quantity(w) != 0.0; });
  };
  if (model.bulk_drive || measured.kicks > 0) {
    measured.bulk_in = estimate([](const auto& w) { return w.bulk_in / w.duration; });
  }
  if (counts.nudges > 0) {
    measured.nudges_in = estimate([](const auto& w) { return w.nudges_in / w.duration; });
  }
  if (model.has_gravity() || occurred([](const auto& w) { return w.gravity_in; })) {
    measured.gravity_in = estimate([](const auto& w) { return w.gravity_in / w.duration; });
  }
  if (model.contact_time || occurred([](const auto& w) { return w.undissipated; })) {
    double dissipated = 0.0, undissipated = 0.0;
    for (const WindowTotals<D>& window : windows_) {
      dissipated += window.dissipated;
      undissipated += window.undissipated;
    }
    if (dissipated > 0.0) measured.undissipated_share = undissipated / dissipated;
  }
  if (model.shear_rate) {
    const double rate = *model.shear_rate, volume = model.box.prod();
    const auto stress = [&](int a, int b) {
      return [=](const WindowTotals<D>& w) {
        const int k = 2 * a + b;
        return -(w.plane[k] + w.plane[4 + k] / w.duration) / volume;
      };
    };
    ShearMeans& shear = measured.shear.emplace();
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) shear.stress[a][b] = estimate(stress(a, b));
    }
    measured.shear_in = estimate([](const auto& w) { return w.shear_in / w.duration; });
    if (rate != 0.0) {
      shear.viscosity = estimate([&](const auto& w) { return stress(1, 0)(w) / rate; });
    }
  }
  bool slides = false;
  model.for_walls([&](const Wall& wall) { slides = slides || wall.slides(); });
  measured.shear_stress.assign(2 * D, std::vector<std::optional<Estimate>>(D));
  for (int side = 0; side < 2 * D; ++side) {
    if (!model.walls[side]) continue;
    measured.walls_in = estimate([](const auto& w) { return w.walls_in / w.duration; });
    double area = 1.0;
    for (int axis = 0; axis < D; ++axis) area *= axis == side / 2 ? 1.0 : model.box[axis];
    measured.pressure[side] =
        estimate([&](const auto& w) { return w.wall_impulse[side] / (w.duration * area); });
    if (!slides) continue;
    for (int axis = 0; axis < D; ++axis) {
      if (axis == side / 2) continue;
      measured.shear_stress[side][axis] = estimate([&](const auto& w) {
        // A window from before a change of laws may have no such sum.
        const double drag = w.wall_drag.empty() ? 0.0 : w.wall_drag[D * side + axis];
        return drag / (w.duration * area);
      });
    }
  }
  if (model.species) {
    const std::vector<std::size_t> counts = species_counts(simulation_);
    measured.species = species_means<D>(species_windows_, model, counts);
    measured.pairs = pair_means<D>(species_windows_, model, counts);
  }
  if (!model.fixtures.empty()) {
    measured.walls_in = estimate([](const auto& w) { return w.walls_in / w.duration; });
    measured.fixtures = fixture_means<D>(fixture_windows_, model);
  }
  if (model.free_piston) measured.piston = piston_means(piston_windows_, *model.free_piston);
  const auto first = static_cast<std::size_t>(
      std::ranges::lower_bound(series_.times, averages_start_) - series_.times.begin());
  if (first < compartments_.share_left.size() && compartment_plane(simulation_)) {
    measured.compartments = compartment_means(compartments_, first, count);
  }
  if (model.is_periodic() && model.fixtures.empty() && count >= 2.0) {
    // The total momentum is conserved, so D(N - 1) degrees of freedom carry the temperature.
    const auto virial = series_of(windows_, [](const auto& w) { return w.virial / D; });
    const auto thermal = series_of(windows_, [&](const auto& w) {
      return count * (w.temperature.mean() * count / (count - 1.0)) * w.duration;
    });
    measured.compressibility = ratio_estimate(virial, thermal);
    measured.compressibility->mean += 1.0;
  }
  return measured;
}

template <int D>
Measured Measurement<D>::result(const StopRequest& stop) {
  // The last window ends with the run, possibly a rounding error early.
  const double next_close = averages_start_ + static_cast<double>(windows_.size() + 1) * window_;
  if (started_ && simulation_.time() > next_close - 1e-6 * window_) close_window();
  Measured measured = means();
  if (windows_.empty() || simulation_.particles().empty()) return measured;
  if (balance_) {
    if (windows_.size() % kWindowsPerBalance != 0) close_balance();
    measured.residuals = residuals_;
  }
  if (cells_) {
    measured.profile =
        profile_of(columns_, cells_->grid(), cells_->layout(), fields_, measure_.profile_axis);
    for (const Field field : fields_) measured.profile->species.push_back(species_of(field));
  }
  if (cells_ || balance_) add_maps(measured, stop);
  return measured;
}

template double cells_memory<2>(const Measure&, bool, std::size_t);
template double cells_memory<3>(const Measure&, bool, std::size_t);
template bool averages_go_on<2>(const RunState<2>&, bool, const Model<2>&, const Measure&);
template bool averages_go_on<3>(const RunState<3>&, bool, const Model<3>&, const Measure&);
template class Measurement<2>;
template class Measurement<3>;

}  // namespace clatter
