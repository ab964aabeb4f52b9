#include "engine/physics/temperature.h"

namespace clatter {

double temperature_of(const State<2>& state) {
  double squares = 0.0;
  for (const Vec2& v : state.velocities) squares += v.squaredNorm();
  const auto count = static_cast<double>(state.velocities.size());
  return count > 0.0 ? squares / (2.0 * count) : 0.0;
}

}  // namespace clatter
