#include "engine/laws/wall.h"

#include <cmath>
#include <limits>

#include "engine/physics/fraction.h"

namespace clatter {

double Roughness::friction_in_force() const {
  const bool smooth = !friction && !tangential_restitution;
  return smooth ? 0.0 : friction.value_or(std::numeric_limits<double>::infinity());
}

double Roughness::tangential_restitution_in_force() const {
  const bool smooth = !friction && !tangential_restitution;
  return smooth ? -1.0 : tangential_restitution.value_or(1.0);
}

bool Roughness::any() const {
  return friction_in_force() > 0.0 && tangential_restitution_in_force() > -1.0;
}

bool Roughness::conserves() const {
  return !any() || (std::isinf(friction_in_force()) && tangential_restitution_in_force() == 1.0);
}

WallMotion Wall::motion() const {
  if (!moves()) return {};
  return {kind == WallKind::Sawtooth ? WallPath::Sawtooth : WallPath::Sinusoidal, stroke, frequency,
          phase};
}

double Wall::start_travel() const {
  WallMotion at_start = motion();
  at_start.phase = fraction(phase);
  return wall_state(at_start, 0.0).displacement;
}

double Wall::innermost_travel() const {
  return clatter::innermost_travel(motion());
}

}  // namespace clatter
