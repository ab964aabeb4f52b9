#include "engine/publish/live_profile.h"

#include <algorithm>
#include <cmath>

namespace clatter {

template <int D>
static IntVec<D> columns_in(const Model<D>& model) {
  constexpr double kMaxColumns = 40.0;
  const double diameters = std::round(model.box.x() / model.diameter);
  IntVec<D> columns = IntVec<D>::Ones();
  columns.x() = static_cast<int>(std::clamp(diameters, 1.0, kMaxColumns));
  return columns;
}

template <int D>
LiveProfile<D>::LiveProfile(Simulation<D>& simulation, double window)
    : observer_(simulation, columns_in(simulation.model()),
                moment_layout<D>(kProfiledFields, simulation.model().spins)) {
  simulation.add_observer(observer_);
  simulation.every(simulation.time() + window, window,
                   [this](double) { sums_.add(observer_.close_window()); });
}

template <int D>
Profile LiveProfile<D>::profile() const {
  if (sums_.parts().size() < 2) return {};
  return profile_of(sums_.parts(), observer_.grid(), observer_.layout(), kProfiledFields, Axis::X);
}

template <int D>
LiveResiduals<D>::LiveResiduals(Simulation<D>& simulation, double window)
    : observer_(simulation, columns_in(simulation.model())) {
  profile_.width = simulation.model().box.x() / observer_.cells().x();
  simulation.add_observer(observer_);
  simulation.every(simulation.time() + window, window, [this](double) {
    profile_.residuals.include(observer_.close_window().imbalances);
  });
}

template class LiveProfile<2>;
template class LiveProfile<3>;
template class LiveResiduals<2>;
template class LiveResiduals<3>;

}  // namespace clatter
