#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// One position of a dial.
struct Setting {
  std::string name;
  double value = 0.0;      ///< the number on the dial; NaN: it has none
  Scene scene;             ///< what runs
  double time_step = 0.0;  ///< of the time-stepped engine; 0: the exact one
  double duration = 1.0;   ///< of the run, in that of the others
};

/// Something that a person may turn towards speed or accuracy.
struct ParameterSweep {
  std::string name;  ///< a word, for --dial
  std::string title;
  std::vector<Setting> settings;  ///< from the finest, with which the others are compared
  /// Whether the finest is the limit of the others at value 0, to which they are extrapolated.
  bool has_limit = false;
};

/// The dials that a scene has. Its gas collides every `collision_time` per disk.
std::vector<ParameterSweep> sweeps_of(const Scene& scene, double collision_time);

}  // namespace clatter
