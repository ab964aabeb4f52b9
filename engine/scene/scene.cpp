#include "engine/scene/scene.h"

#include <numbers>

namespace clatter {

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
