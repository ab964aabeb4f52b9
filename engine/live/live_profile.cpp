#include "engine/live/live_profile.h"

#include <algorithm>
#include <cmath>

#include "engine/measure/mean_diameter.h"

namespace clatter {

template <int D>
static IntVec<D> columns_in(const Simulation<D>& simulation, Axis axis) {
  constexpr double kMaxColumns = 40.0;
  const auto along = static_cast<int>(axis);
  const double diameters = std::round(simulation.model().box[along] / mean_diameter(simulation));
  IntVec<D> columns = IntVec<D>::Ones();
  columns[along] = static_cast<int>(std::clamp(diameters, 1.0, kMaxColumns));
  return columns;
}

std::vector<Field> profiled_fields(Axis axis, std::size_t species) {
  const auto common = profiled_fields(axis);
  std::vector<Field> fields(common.begin(), common.end());
  for (std::size_t s = 0; s < species; ++s) {
    fields.push_back(Field(Quantity::Density).of(s));
    fields.push_back(Field(Quantity::Temperature).of(s));
  }
  return fields;
}

// The fields of the profile of a run.
template <int D>
static std::vector<Field> fields_in(const Simulation<D>& simulation, Axis axis) {
  const auto& species = simulation.model().species;
  return profiled_fields(axis, species ? species->count() : 0);
}

template <int D>
LiveProfile<D>::LiveProfile(Simulation<D>& simulation, double window, Axis axis)
    : axis_(axis),
      fields_(fields_in(simulation, axis)),
      start_(simulation.time() + window),
      observer_(simulation, columns_in(simulation, axis),
                moment_layout<D>(fields_, simulation.model().spins, simulation.is_mixture())),
      observation_(simulation, observer_),
      timers_(simulation) {
  watch(window);
}

template <int D>
LiveProfile<D>::LiveProfile(Simulation<D>& simulation, double window, Axis axis,
                            ArchiveReader& saved)
    : axis_(axis),
      fields_(fields_in(simulation, axis)),
      start_(0.0),
      observer_(simulation, columns_in(simulation, axis),
                moment_layout<D>(fields_, simulation.model().spins, simulation.is_mixture())),
      observation_(simulation, observer_),
      timers_(simulation) {
  saved(*this);
  saved.require(!simulation.is_overdue(start_, window, closed_));
  watch(window);
}

template <int D>
void LiveProfile<D>::watch(double window) {
  const auto close = [this](double) {
    sums_.add(observer_.close_window());
    ++closed_;
  };
  timers_.every(start_, window, close, closed_);
}

template <int D>
Profile LiveProfile<D>::profile() const {
  if (sums_.parts().size() < 2) return {};
  return profile_of(sums_.parts(), observer_.grid(), observer_.layout(), fields_, axis_);
}

template <int D>
LiveResiduals<D>::LiveResiduals(Simulation<D>& simulation, double window, Axis axis)
    : observer_(simulation, columns_in(simulation, axis)),
      observation_(simulation, observer_),
      timers_(simulation) {
  const auto along = static_cast<int>(axis);
  profile_.axis = axis;
  profile_.width = simulation.model().box[along] / observer_.cells()[along];
  timers_.every(simulation.time() + window, window, [this](double) {
    profile_.residuals.include(observer_.close_window().imbalances);
  });
}

template class LiveProfile<2>;
template class LiveProfile<3>;
template class LiveResiduals<2>;
template class LiveResiduals<3>;

}  // namespace clatter
