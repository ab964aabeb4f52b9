#pragma once

#include <string>

#include "tests/support/shell.h"

namespace clatter {

/// A scene without symmetry: the walls differ, and gravity is oblique.
inline const std::string kSweepScene = R"(
box.size = [9.0, 7.0]
particles = { count = 8, restitution = 0.9 }
gravity.acceleration = [0.03, -0.1]
measure = { burn_in = 2.0, duration = 30, fields = ["density"], cells = [3, 2] }
[walls.left]
kind = "driven"
drive_speed = 1.0
[walls.right]
kind = "thermal"
temperature = 0.7
[walls.bottom]
kind = "thermal"
temperature = 1.5
[walls.top]
kind = "static"
)";

/// A sweep over the scene in a.toml, with an override.
inline const std::string kSweep = R"(scene = "a.toml"
seeds = [4, 2, 9]
[set]
"measure.profile_axis" = "y"
[axes]
"particles.restitution" = [0.7, 0.95]
"walls.right.temperature" = [0.5, 2.0]
)";

/// Writes the scene and the sweep, s.toml.
inline void write_sweep(const Shell& shell) {
  shell.write("a.toml", kSweepScene);
  shell.write("s.toml", kSweep);
}

}  // namespace clatter
