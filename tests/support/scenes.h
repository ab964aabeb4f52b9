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

/// The same in a box of two or three sides.
inline Scene gas(const VecX& box, int count, double restitution) {
  Scene scene = default_scene(static_cast<int>(box.size()));
  scene.box = box;
  scene.particles.count = count;
  scene.particles.restitution = restitution;
  return scene;
}

/// Puts the same wall at both ends of an axis (0: x, 1: y, 2: z).
inline void wall_in(Scene& scene, int axis, const Wall& wall) {
  scene.walls[2 * axis] = scene.walls[2 * axis + 1] = wall;
}

/// Grains under gravity that come to rest on a floor.
inline Scene collapsing_gas() {
  Scene scene = gas(8.0, 12.0, 20, 0.5);
  scene.gravity = Vec2(0.0, -1.0);
  wall_in(scene, 1, Wall{.kind = WallKind::Static, .restitution = 0.5});
  return scene;
}

/// Rough spheres under gravity between six walls of different kinds or temperatures.
inline Scene rough_spheres(int count) {
  Scene scene = default_scene(3);
  scene.box = Vec<3>(6.0, 5.0, 7.0);
  scene.particles.count = count;
  scene.particles.restitution = 0.9;
  scene.particles.roughness = {.friction = 0.4, .tangential_restitution = 0.6};
  scene.particles.start.spin_temperature = 0.8;
  scene.gravity = Vec<3>(0.1, -0.4, 0.2);
  scene.walls = {Wall{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.5},
                 Wall{.kind = WallKind::Static, .restitution = 0.7},
                 Wall{.kind = WallKind::Thermal, .temperature = 0.5},
                 Wall{.kind = WallKind::Thermal, .temperature = 2.0},
                 Wall{.kind = WallKind::Sawtooth, .stroke = 0.3, .frequency = 1.1},
                 Wall{.kind = WallKind::Sinusoidal, .stroke = 0.4, .frequency = 0.8}};
  return scene;
}

}  // namespace clatter::testing
