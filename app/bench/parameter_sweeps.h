#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// One value of a swept parameter.
struct Setting {
  std::string name;
  double value = 0.0;      ///< value of the parameter; NaN: none
  Scene scene;             ///< the simulated scene
  double time_step = 0.0;  ///< of the time-stepped engine; 0: exact engine
  double duration = 1.0;   ///< of the run, relative to the others
};

/// A parameter that trades speed for accuracy.
struct ParameterSweep {
  std::string name;  ///< a word, for --dial
  std::string title;
  std::vector<Setting> settings;  ///< from the finest, which is the reference
  /// Whether the finest setting is the limit of the others at value 0. The others are then
  /// extrapolated.
  bool has_limit = false;
};

/// The parameters of a scene. `collision_time` is the mean time between collisions per disk.
std::vector<ParameterSweep> sweeps_of(const Scene& scene, double collision_time);

}  // namespace clatter
