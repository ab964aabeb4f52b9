#include "engine/scene/scene.h"

#include <limits>
#include <numbers>

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

double Scene::area_fraction() const {
  return particles.count * std::numbers::pi / (4.0 * box.x() * box.y());
}

Vec2 Scene::clear_corner() const {
  Vec2 corner(0.0, 0.0);
  for (int axis = 0; axis < 2; ++axis) {
    if (const auto& wall = walls[2 * axis]) corner[axis] = wall->innermost_travel();
  }
  return corner;
}

Vec2 Scene::clear_box() const {
  Vec2 size = box - clear_corner();
  for (int axis = 0; axis < 2; ++axis) {
    if (const auto& wall = walls[2 * axis + 1]) size[axis] -= wall->innermost_travel();
  }
  return size;
}

bool Scene::spins() const {
  bool any = particles.roughness.any();
  for (const auto& wall : walls) any = any || (wall && wall->roughness.any());
  return any;
}

}  // namespace clatter
