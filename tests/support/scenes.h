#pragma once

#include "engine/scene/scene.h"

namespace clatter::testing {

/// A gas in a periodic box: random start, T = 1.
inline Scene gas(double lx, double ly, int count, double restitution) {
  Scene scene;
  scene.box = Vec2(lx, ly);
  scene.particles.count = count;
  scene.particles.restitution = restitution;
  return scene;
}

/// The same wall at both ends of an axis (0: x, 1: y).
inline void wall_in(Scene& scene, int axis, const Wall& wall) {
  scene.walls[2 * axis] = scene.walls[2 * axis + 1] = wall;
}

}  // namespace clatter::testing
