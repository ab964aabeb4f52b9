#include "engine/physics/state.h"

namespace clatter {

template <int D>
double temperature_of(const State<D>& state) {
  double squares = 0.0;
  for (const Vec<D>& v : state.velocities) squares += v.squaredNorm();
  const auto count = static_cast<double>(state.velocities.size());
  return count > 0.0 ? squares / (D * count) : 0.0;
}

template double temperature_of(const State<2>&);
template double temperature_of(const State<3>&);

}  // namespace clatter
