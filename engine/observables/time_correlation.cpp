#include "engine/observables/time_correlation.h"

#include <string>

#include "engine/scene/scene_keys.h"

namespace clatter {

namespace {

// Results of the rows of a table of lags. Each row of the sums has the number of samples, and then
// `columns` sums.
class LagTable {
 public:
  LagTable(std::string name, double interval, const std::vector<std::uint64_t>& lags,
           std::span<const ObservableSums> parts, std::size_t row)
      : table_{std::move(name), {{"time", "t", {}}}}, parts_(parts), row_(row), lags_(lags.size()) {
    for (const std::uint64_t lag : lags) {
      table_.columns[0].values.push_back(static_cast<double>(lag) * interval);
    }
  }

  // The sum of `count` consecutive sums from `first`, times `scale`, per sample.
  void add(std::string name, const std::string& unit, std::size_t first, std::size_t count,
           double scale) {
    TableColumn column{std::move(name), unit, {}};
    for (std::size_t lag = 0; lag < lags_; ++lag) {
      std::vector<ObservableSums> sums;
      for (const ObservableSums& part : parts_) {
        double sum = 0.0;
        for (std::size_t k = first; k < first + count; ++k) sum += part.values[lag * row_ + k];
        sums.push_back({{scale * sum, part.values[lag * row_]}});
      }
      append(column, ratio_of(sums, 0, 1));
    }
    table_.columns.push_back(std::move(column));
  }

  ResultTable table() && { return std::move(table_); }

 private:
  ResultTable table_;
  std::span<const ObservableSums> parts_;
  std::size_t row_;
  std::size_t lags_;
};

std::string axis_name(int axis) {
  return std::string(kAxes[static_cast<std::size_t>(axis)].name);
}

}  // namespace

template <int D>
void MeanSquaredDisplacement<D>::start() {
  images_.emplace(simulation_);
  sums_.values.assign(history_.lags().size() * (1 + 2 * D), 0.0);
}

template <int D>
void MeanSquaredDisplacement<D>::restore(ArchiveReader& io) {
  start();
  io(history_, *images_, sums_);
  io.require(sums_.values.size() == history_.lags().size() * (1 + 2 * D));
}

template <int D>
void MeanSquaredDisplacement<D>::sample() {
  if (simulation_.particles().empty()) return;
  const State<D> state = simulation_.state();
  const std::vector<IntVec<D>> images = images_->images();
  std::vector<Vec<D>> unwrapped = state.positions;
  for (std::size_t i = 0; i < unwrapped.size(); ++i) {
    unwrapped[i] += images[i].template cast<double>().cwiseProduct(simulation_.model().box);
  }
  const double per_particle = 1.0 / static_cast<double>(unwrapped.size());
  history_.add(unwrapped, [&](std::size_t lag, const std::vector<Vec<D>>& earlier) {
    Vec<D> drift = Vec<D>::Zero(), squares = Vec<D>::Zero();
    for (std::size_t i = 0; i < unwrapped.size(); ++i) {
      const Vec<D> moved = unwrapped[i] - earlier[i];
      drift += moved;
      squares += moved.cwiseAbs2();
    }
    double* const row = &sums_.values[lag * (1 + 2 * D)];
    row[0] += 1.0;
    for (int axis = 0; axis < D; ++axis) {
      row[1 + axis] += drift[axis] * per_particle;
      row[1 + D + axis] += squares[axis] * per_particle;
    }
  });
}

template <int D>
ObservableSums MeanSquaredDisplacement<D>::close_window() {
  ObservableSums window = sums_;
  sums_.values.assign(window.values.size(), 0.0);
  return window;
}

template <int D>
ObservableResult MeanSquaredDisplacement<D>::result(std::span<const ObservableSums> parts) const {
  LagTable table("mean_squared_displacement", settings_.interval, history_.lags(), parts,
                 1 + 2 * D);
  table.add("total", "a^2", 1 + D, D, 1.0);
  for (int axis = 0; axis < D; ++axis) {
    table.add(axis_name(axis), "a^2", static_cast<std::size_t>(1 + D + axis), 1, 1.0);
  }
  for (int axis = 0; axis < D; ++axis) {
    table.add("drift_" + axis_name(axis), "a", static_cast<std::size_t>(1 + axis), 1, 1.0);
  }
  return {{std::move(table).table()}, {}};
}

template <int D>
void VelocityAutocorrelation<D>::start() {
  sums_.values.assign(history_.lags().size() * (1 + D), 0.0);
}

template <int D>
void VelocityAutocorrelation<D>::restore(ArchiveReader& io) {
  io(history_, sums_);
  io.require(sums_.values.size() == history_.lags().size() * (1 + D));
}

template <int D>
void VelocityAutocorrelation<D>::sample() {
  if (simulation_.particles().empty()) return;
  std::vector<Vec<D>> velocities;
  velocities.reserve(simulation_.particles().size());
  for (const Particle<D>& particle : simulation_.particles()) {
    velocities.push_back(
        particle.flight.velocity_at(simulation_.base_time(), simulation_.model().gravity));
  }
  const double per_particle = 1.0 / static_cast<double>(velocities.size());
  history_.add(velocities, [&](std::size_t lag, const std::vector<Vec<D>>& earlier) {
    Vec<D> products = Vec<D>::Zero();
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      products += velocities[i].cwiseProduct(earlier[i]);
    }
    double* const row = &sums_.values[lag * (1 + D)];
    row[0] += 1.0;
    for (int axis = 0; axis < D; ++axis) row[1 + axis] += products[axis] * per_particle;
  });
}

template <int D>
ObservableSums VelocityAutocorrelation<D>::close_window() {
  ObservableSums window = sums_;
  sums_.values.assign(window.values.size(), 0.0);
  return window;
}

template <int D>
ObservableResult VelocityAutocorrelation<D>::result(std::span<const ObservableSums> parts) const {
  LagTable table("velocity_autocorrelation", settings_.interval, history_.lags(), parts, 1 + D);
  table.add("mean", "a^2/t^2", 1, D, 1.0 / D);
  for (int axis = 0; axis < D; ++axis) {
    table.add(axis_name(axis), "a^2/t^2", static_cast<std::size_t>(1 + axis), 1, 1.0);
  }
  return {{std::move(table).table()}, {}};
}

template class MeanSquaredDisplacement<2>;
template class MeanSquaredDisplacement<3>;
template class VelocityAutocorrelation<2>;
template class VelocityAutocorrelation<3>;

}  // namespace clatter
