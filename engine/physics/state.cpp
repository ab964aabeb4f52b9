#include "engine/physics/state.h"

namespace clatter {

template <int D>
double temperature_of(const State<D>& state) {
  double squares = 0.0;
  for (std::size_t i = 0; i < state.velocities.size(); ++i) {
    const double mass = state.grains.empty() ? 1.0 : state.grains[i].mass;
    squares += mass * state.velocities[i].squaredNorm();
  }
  const auto count = static_cast<double>(state.velocities.size());
  return count > 0.0 ? squares / (D * count) : 0.0;
}

template double temperature_of(const State<2>&);
template double temperature_of(const State<3>&);

}  // namespace clatter
