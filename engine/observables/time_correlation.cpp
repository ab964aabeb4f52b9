#include "engine/observables/time_correlation.h"

#include <string>

#include "engine/observables/lag_table.h"
#include "engine/scene/enum_names.h"

namespace clatter {

namespace {

std::string axis_name(int axis) {
  return std::string(kAxes[static_cast<std::size_t>(axis)].name);
}

}  // namespace

template <int D>
void MeanSquaredDisplacement<D>::start() {
  Observable::start();
  images_.emplace(simulation_);
}

template <int D>
void MeanSquaredDisplacement<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  io(history_, *images_);
}

template <int D>
void MeanSquaredDisplacement<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  images_.emplace(simulation_);
  io(history_, *images_);
  io.require(history_.is_complete(simulation_.particles().size()));
}

template <int D>
void MeanSquaredDisplacement<D>::sample() {
  if (simulation_.particles().empty()) return;
  const State<D> state = simulation_.state();
  const std::vector<IntVec<D>> images = images_->images();
  const Domain<D> domain = simulation_.model().domain();
  std::vector<Vec<D>> unwrapped = state.positions;
  for (std::size_t i = 0; i < unwrapped.size(); ++i) {
    unwrapped[i] += domain.shift(images[i].template cast<double>());
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
ObservableResult MeanSquaredDisplacement<D>::result(const ObservableParts& parts) const {
  LagTable table("mean_squared_displacement", settings_.interval, history_.lags(), parts.coarse,
                 {0, 1 + 2 * D});
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
void VelocityAutocorrelation<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  io(history_);
}

template <int D>
void VelocityAutocorrelation<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  io(history_);
  io.require(history_.is_complete(simulation_.particles().size()));
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
ObservableResult VelocityAutocorrelation<D>::result(const ObservableParts& parts) const {
  LagTable table("velocity_autocorrelation", settings_.interval, history_.lags(), parts.coarse,
                 {0, 1 + D});
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
