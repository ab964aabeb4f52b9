#include "engine/publish/live_profile.h"

#include <algorithm>
#include <cmath>

namespace clatter {

static IntVec<2> columns_in(const Model<2>& model) {
  constexpr double kMaxColumns = 40.0;
  return {
      static_cast<int>(std::clamp(std::round(model.box.x() / model.diameter), 1.0, kMaxColumns)),
      1};
}

LiveProfile::LiveProfile(Simulation<2>& simulation, double window)
    : observer_(simulation, columns_in(simulation.model()),
                moment_layout<2>(kFields, simulation.model().spins)) {
  simulation.add_observer(observer_);
  simulation.every(simulation.time() + window, window,
                   [this](double) { sums_.add(observer_.close_window()); });
}

Profile LiveProfile::profile() const {
  if (sums_.parts().size() < 2) return {};
  return profile_of(sums_.parts(), observer_.grid(), observer_.layout(), kFields, Axis::X);
}

LiveResiduals::LiveResiduals(Simulation<2>& simulation, double window)
    : observer_(simulation, columns_in(simulation.model())) {
  profile_.width = simulation.model().box.x() / observer_.cells().x();
  simulation.add_observer(observer_);
  simulation.every(simulation.time() + window, window, [this](double) {
    profile_.residuals.include(observer_.close_window().imbalances);
  });
}

}  // namespace clatter
