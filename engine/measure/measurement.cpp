#include "engine/measure/measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clatter {

// Enough windows for the blocking to see correlations; more where the scene asks for a finer
// series.
static constexpr double kLeastWindows = 512.0;
static constexpr double kMostWindows = 8192.0;

Measurement::Measurement(Simulation<2>& simulation, const Measure& measure, double end)
    : simulation_(simulation),
      measure_(measure),
      totals_(simulation),
      series_start_(std::ceil(simulation.time() / measure.series_interval) *
                    measure.series_interval),
      averages_start_(std::max(measure.burn_in, simulation.time())) {
  const double span = end - averages_start_;
  window_ =
      span / std::clamp(std::ceil(span / measure.series_interval), kLeastWindows, kMostWindows);
  observe();
}

Measurement::Measurement(Simulation<2>& simulation, const Measure& measure, ArchiveReader saved)
    : simulation_(simulation), measure_(measure), totals_(simulation) {
  visit(saved);
  saved.finish();
  // Where other laws have brought or taken spins: there were none, or there are none.
  series_spin_temperature_.resize(simulation.spins().empty() ? 0 : series_time_.size());
  observe();
}

std::string Measurement::save() {
  ArchiveWriter writer;
  visit(writer);
  return writer.written();
}

template <class Archive>
void Measurement::visit(Archive& io) {
  auto& [simulation, measure, totals, cells, series_start, averages_start, window, started,
         counts_at_start, windows, columns, series_time, series_temperature,
         series_spin_temperature] = *this;
  io(totals, series_start, averages_start, window, started, counts_at_start, windows, columns,
     series_time, series_temperature, series_spin_temperature);
  if (!started || measure.fields.empty()) return;
  if (!cells) cells.emplace(simulation, IntVec<2>(measure.cells[0], measure.cells[1]));
  io(*cells);
}

void Measurement::observe() {
  simulation_.add_observer(totals_);
  if (cells_) simulation_.add_observer(*cells_);
  simulation_.every(
      series_start_, measure_.series_interval, [this](double time) { sample(time); },
      series_time_.size());
  simulation_.every(
      averages_start_, window_, [this](double) { started_ ? close_window() : start(); },
      started_ ? windows_.size() + 1 : 0);
}

void Measurement::sample(double time) {
  const auto count = static_cast<double>(simulation_.disks().size());
  series_time_.push_back(time);
  series_temperature_.push_back(count > 0.0 ? simulation_.kinetic_energy() / count : 0.0);
  if (!simulation_.spins().empty()) {
    series_spin_temperature_.push_back(2.0 * simulation_.spin_energy() / count);
  }
}

void Measurement::start() {
  started_ = true;
  totals_.close_window();
  counts_at_start_ = simulation_.counts();
  if (!measure_.fields.empty()) {
    cells_.emplace(simulation_, IntVec<2>(measure_.cells[0], measure_.cells[1]));
    simulation_.add_observer(*cells_);
  }
}

void Measurement::close_window() {
  windows_.push_back(totals_.close_window());
  if (!cells_) return;
  const std::vector<CellMoments<2>> cells = cells_->close_window();
  const auto width = static_cast<std::size_t>(cells_->cells().x());
  std::vector<CellMoments<2>> columns(width);
  for (std::size_t i = 0; i < cells.size(); ++i) columns[i % width] += cells[i];
  columns_.push_back(std::move(columns));
}

// A quantity that each window has.
template <typename Window, typename Quantity>
static std::vector<double> series_of(const std::vector<Window>& windows, const Quantity& quantity) {
  std::vector<double> series;
  series.reserve(windows.size());
  for (const Window& window : windows) series.push_back(quantity(window));
  return series;
}

static Estimate kurtosis_excess(const std::vector<WindowTotals<2>>& windows, int axis) {
  const auto second = series_of(windows, [&](const auto& w) { return w.second_moment[axis]; });
  auto fourth = series_of(windows, [&](const auto& w) { return w.fourth_moment[axis]; });
  const double m2 = mean_estimate(second).mean;
  const double m4 = mean_estimate(fourth).mean;
  if (!(m2 > 0.0)) return {};
  // Linearised about the means: d(m4/m2^2) = dm4/m2^2 - 2 m4 dm2/m2^3.
  for (std::size_t k = 0; k < fourth.size(); ++k) {
    fourth[k] = (fourth[k] / (m2 * m2) - 2.0 * m4 * second[k] / (m2 * m2 * m2)) / 3.0;
  }
  return {m4 / (3.0 * m2 * m2) - 1.0, blocked_error(std::move(fourth))};
}

// T_k = <v_k^2> - V_k^2 of one column, linearised likewise for its error.
static Estimate column_temperature(const std::vector<std::vector<CellMoments<2>>>& windows,
                                   std::size_t column, int axis) {
  const auto of = [&](const auto& part) {
    return series_of(windows, [&](const auto& columns) { return part(columns[column]); });
  };
  const auto count = of([](const CellMoments<2>& m) { return m.count; });
  const auto first = of([&](const CellMoments<2>& m) { return m.velocity[axis]; });
  auto second = of([&](const CellMoments<2>& m) { return m.velocity_squared[axis]; });
  if (mean_estimate(count).mean == 0.0) return {std::numeric_limits<double>::quiet_NaN(), 0.0};
  const double velocity = ratio_estimate(first, count).mean;
  const double square = ratio_estimate(second, count).mean;
  for (std::size_t k = 0; k < second.size(); ++k) {
    second[k] += -2.0 * velocity * first[k] + (2.0 * velocity * velocity - square) * count[k];
  }
  return {square - velocity * velocity, ratio_estimate(second, count).standard_error};
}

static Profile profile_of(const std::vector<std::vector<CellMoments<2>>>& windows, const Vec2& box,
                          double window) {
  const std::size_t columns = windows.front().size();
  const double measure = window * box.prod() / static_cast<double>(columns);
  Profile profile;
  for (std::size_t i = 0; i <= columns; ++i) {
    profile.edges.push_back(box.x() * static_cast<double>(i) / static_cast<double>(columns));
  }
  for (std::size_t i = 0; i < columns; ++i) {
    profile.density.push_back(
        mean_estimate(series_of(windows, [&](const auto& c) { return c[i].count / measure; })));
    profile.temperature_x.push_back(column_temperature(windows, i, 0));
    profile.temperature_y.push_back(column_temperature(windows, i, 1));
  }
  return profile;
}

Measured Measurement::result() {
  const Model<2>& model = simulation_.model();
  const auto count = static_cast<double>(simulation_.disks().size());
  // The last window ends with the run, perhaps a rounding error before its time.
  const double next_close = averages_start_ + static_cast<double>(windows_.size() + 1) * window_;
  if (started_ && simulation_.time() > next_close - 1e-6 * window_) close_window();
  Measured measured;
  measured.burn_in = averages_start_;
  measured.series_time = series_time_;
  measured.series_temperature = series_temperature_;
  measured.series_spin_temperature = series_spin_temperature_;
  measured.ledger_residual = totals_.ledger_residual();
  if (windows_.empty() || count == 0.0) return measured;
  const auto estimate = [&](const auto& quantity) {
    return mean_estimate(series_of(windows_, quantity));
  };
  measured.duration = static_cast<double>(windows_.size()) * window_;
  const EventCounts& counts = simulation_.counts();
  measured.disk_disk = counts.disk_disk - counts_at_start_.disk_disk;
  measured.disk_wall = counts.disk_wall - counts_at_start_.disk_wall;
  measured.kicks = counts.kicks - counts_at_start_.kicks;
  measured.elasticised = counts.elasticised - counts_at_start_.elasticised;
  measured.elasticised_wall = counts.elasticised_wall - counts_at_start_.elasticised_wall;
  measured.temperature = estimate([](const auto& w) { return 0.5 * w.temperature.sum(); });
  measured.temperature_x = estimate([](const auto& w) { return w.temperature.x(); });
  measured.temperature_y = estimate([](const auto& w) { return w.temperature.y(); });
  measured.kurtosis_excess_x = kurtosis_excess(windows_, 0);
  measured.kurtosis_excess_y = kurtosis_excess(windows_, 1);
  if (model.spins) {
    measured.spin_temperature = estimate([](const auto& w) { return w.spin_temperature; });
  }
  measured.collision_rate =
      estimate([&](const auto& w) { return 2.0 * w.collisions / (count * w.duration); });
  measured.dissipated = estimate([](const auto& w) { return w.dissipated / w.duration; });
  if (model.bulk_drive) {
    measured.bulk_in = estimate([](const auto& w) { return w.bulk_in / w.duration; });
  }
  if ((model.gravity.array() != 0.0).any()) {
    measured.gravity_in = estimate([](const auto& w) { return w.gravity_in / w.duration; });
  }
  if (model.contact_time) {
    double dissipated = 0.0, undissipated = 0.0;
    for (const WindowTotals<2>& window : windows_) {
      dissipated += window.dissipated;
      undissipated += window.undissipated;
    }
    if (dissipated > 0.0) measured.undissipated_share = undissipated / dissipated;
  }
  for (int side = 0; side < 4; ++side) {
    if (!model.walls[side]) continue;
    measured.walls_in = estimate([](const auto& w) { return w.walls_in / w.duration; });
    const double length = model.box[1 - side / 2];
    measured.pressure[side] =
        estimate([&](const auto& w) { return w.wall_impulse[side] / (w.duration * length); });
  }
  if (model.periodic(0) && model.periodic(1) && count >= 2.0) {
    // Both momenta are conserved, so 2(N - 1) degrees of freedom carry the temperature.
    const auto virial = series_of(windows_, [](const auto& w) { return 0.5 * w.virial; });
    const auto thermal = series_of(windows_, [&](const auto& w) {
      return count * (0.5 * w.temperature.sum() * count / (count - 1.0)) * w.duration;
    });
    measured.compressibility = ratio_estimate(virial, thermal);
    measured.compressibility->mean += 1.0;
  }
  if (!columns_.empty()) measured.profile = profile_of(columns_, model.box, window_);
  return measured;
}

}  // namespace clatter
