#include "engine/observables/time_correlation.h"

#include <string>

#include "engine/observables/lag_table.h"

namespace clatter {

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
  const Domain<D> domain = simulation_.domain();
  std::vector<Vec<D>> unwrapped = state.positions;
  for (std::size_t i = 0; i < unwrapped.size(); ++i) {
    unwrapped[i] += domain.shift(images[i].template cast<double>());
  }
  history_.add(unwrapped, [&](std::size_t lag, const std::vector<Vec<D>>& earlier) {
    double* const row = &sums_.values[lag * row_size()];
    row[0] += 1.0;
    for (std::size_t group = 0; group < groups_.count(); ++group) {
      Vec<D> drift = Vec<D>::Zero(), squares = Vec<D>::Zero();
      groups_.for_each(group, [&](std::size_t i) {
        const Vec<D> moved = unwrapped[i] - earlier[i];
        drift += moved;
        squares += moved.cwiseAbs2();
      });
      double* const sums = row + 1 + 2 * D * group;
      for (int axis = 0; axis < D; ++axis) {
        sums[axis] += drift[axis] * groups_.per_particle(group);
        sums[D + axis] += squares[axis] * groups_.per_particle(group);
      }
    }
  });
}

template <int D>
ObservableResult MeanSquaredDisplacement<D>::result(const ObservableParts& parts) const {
  LagTable table("mean_squared_displacement", settings_.interval, history_.lags(), parts.coarse,
                 {0, row_size()});
  for (std::size_t group = 0; group < groups_.count(); ++group) {
    const std::size_t drift = 1 + 2 * D * group, squares = drift + D;
    const std::string of = groups_.suffix(group);
    // Along x the flow carries the particles of a sheared box.
    const std::size_t first = simulation_.model().shear_rate ? 1 : 0;
    table.add("total" + of, "a^2", squares + first, D - first, 1.0);
    for (std::size_t axis = first; axis < D; ++axis) {
      table.add(axis_name(axis) + of, "a^2", squares + axis, 1, 1.0);
    }
    for (std::size_t axis = first; axis < D; ++axis) {
      table.add("drift_" + axis_name(axis) + of, "a", drift + axis, 1, 1.0);
    }
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
    velocities.push_back(simulation_.peculiar_at(particle.flight, simulation_.base_time()));
  }
  history_.add(velocities, [&](std::size_t lag, const std::vector<Vec<D>>& earlier) {
    double* const row = &sums_.values[lag * row_size()];
    row[0] += 1.0;
    for (std::size_t group = 0; group < groups_.count(); ++group) {
      Vec<D> products = Vec<D>::Zero();
      groups_.for_each(group,
                       [&](std::size_t i) { products += velocities[i].cwiseProduct(earlier[i]); });
      double* const sums = row + 1 + D * group;
      for (int axis = 0; axis < D; ++axis) {
        sums[axis] += products[axis] * groups_.per_particle(group);
      }
    }
  });
}

template <int D>
ObservableResult VelocityAutocorrelation<D>::result(const ObservableParts& parts) const {
  LagTable table("velocity_autocorrelation", settings_.interval, history_.lags(), parts.coarse,
                 {0, row_size()});
  for (std::size_t group = 0; group < groups_.count(); ++group) {
    const std::size_t first = 1 + D * group;
    const std::string of = groups_.suffix(group);
    table.add("mean" + of, "a^2/t^2", first, D, 1.0 / D);
    for (std::size_t axis = 0; axis < D; ++axis) {
      table.add(axis_name(axis) + of, "a^2/t^2", first + axis, 1, 1.0);
    }
  }
  return {{std::move(table).table()}, {}};
}

template class MeanSquaredDisplacement<2>;
template class MeanSquaredDisplacement<3>;
template class VelocityAutocorrelation<2>;
template class VelocityAutocorrelation<3>;

}  // namespace clatter
