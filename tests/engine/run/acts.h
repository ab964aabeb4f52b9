#pragma once

#include <string>

#include "engine/live/watched_run.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"

// Scenes and hashes of the tests of nudges, strokes of the piston, and puffs.

namespace clatter::testing {

inline constexpr std::uint64_t kActSeed = 21;

/// Two gases of disks between walls: one with a bulk drive, and one with a piston.
inline const std::string kDrivenDisks =
    "box.size = [12, 10]\nparticles = { count = 40, restitution = 0.9 }\n"
    "walls.left = { kind = 'driven', drive_speed = 0.3 }\nwalls.right = { kind = 'static' }\n"
    "gravity.acceleration = [0.0, -0.1]\nbulk_drive = { interval = 0.5, kick_speed = 0.05 }\n";
inline std::string with_piston(const std::string& right_wall) {
  return "box.size = [12, 10]\nparticles = { count = 40, restitution = 0.9 }\n"
         "walls.left = { kind = 'thermal', temperature = 1.0 }\nwalls.right = { " +
         right_wall + " }\n";
}

/// All kinds of walls that can be a piston.
inline const std::string kPistons[] = {
    "kind = 'static'",
    "kind = 'static', restitution = 0.5, friction = 0.3",
    "kind = 'driven', drive_speed = 0.3",
    "kind = 'thermal', temperature = 0.5",
    "kind = 'sinusoidal', stroke = 0.4, frequency = 0.7",
    "kind = 'sawtooth', stroke = 0.3, frequency = 0.5, restitution = 0.7",
};

/// A gas with nudges. At t = 2 a kick of the bulk drive comes before the change of laws and its
/// nudge.
inline Scene nudged() {
  return parse_scene(kDrivenDisks +
                         "[[change]]\ntime = 2.0\nset = { 'particles.restitution' = 0.8 }\n"
                         "nudge = { centre = [11.5, 0.5], radius = 3.0, scale = 2.0 }\n"
                         "[[change]]\ntime = 3.3\nnudge = { centre = [4.0, 5.0], radius = 2.5, add "
                         "= [1.0, 0.5] }\n"
                         "[[change]]\ntime = 3.3\nnudge = { particle = 17, set = [-3.0, 1.0] }\n",
                     "s.toml");
}

/// A gas whose piston moves in, out, and in again.
inline Scene compressed(const std::string& right_wall = kPistons[1]) {
  return parse_scene(with_piston(right_wall) +
                         "gravity.acceleration = [0.05, -0.1]\n"
                         "[[change]]\ntime = 1.0\npiston = 8.5\nuntil = 3.0\n"
                         "[[change]]\ntime = 3.0\npiston = 11.0\nuntil = 3.5\n"
                         "[[change]]\ntime = 4.25\npiston = 7.5\nuntil = 5.0\n",
                     "s.toml");
}

/// A gas with puffs, a stroke and a nudge. At t = 2 a kick of the bulk drive comes before the
/// change of laws, and both before the puff.
inline Scene puffed() {
  return parse_scene(
      "box.size = [16, 12]\nparticles = { count = 30, restitution = 0.9, friction = 0.5 }\n"
      "walls.left = { kind = 'driven', drive_speed = 0.3 }\nwalls.right = { kind = 'static' }\n"
      "walls.bottom = { kind = 'sinusoidal', stroke = 0.4, frequency = 1.5 }\n"
      "walls.top = { kind = 'thermal', temperature = 1.0 }\ncollapse.contact_time = 1e-4\n"
      "gravity.acceleration = [0.0, -0.1]\nbulk_drive = { interval = 0.5, kick_speed = 0.05 }\n"
      "[[change]]\ntime = 1.5\npiston = 13.0\nuntil = 2.5\n"
      "[[change]]\ntime = 2.0\nset = { 'particles.restitution' = 0.8 }\n"
      "[[change]]\ntime = 2.0\n"
      "puff = { count = 9, centre = [16, 0], radius = 7, temperature = 2 }\n"
      "[[change]]\ntime = 3.3\npuff = { count = 5, centre = [2, 8], radius = 4, velocity = [1, 0] "
      "}\n"
      "[[change]]\ntime = 3.3\nnudge = { particle = 43, set = [-3.0, 1.0] }\n",
      "s.toml");
}

inline Frame filled_frame(WatchedRun& run) {
  Frame frame;
  run.fill(frame, true);
  return frame;
}

inline std::uint64_t hash_of_run(const Scene& scene, double time) {
  ScheduledRun<2> run(scene, kActSeed);
  run.run_until(time);
  return run.simulation().state_hash();
}

/// The scene that a frame would save, read again.
inline Scene saved_scene(const Frame& frame) {
  Scene scene = *frame.started;
  scene.changes = frame.scene->changes;
  return parse_scene(scene_to_toml(scene), "saved.toml");
}

}  // namespace clatter::testing
