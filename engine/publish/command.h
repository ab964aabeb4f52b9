#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// What a person asks of a gas that runs.
namespace command {

/// Lets simulation time go on, or halts it.
struct Play {
  bool on = true;
};
/// Goes on by a time and halts there.
struct Step {
  double duration = 0.0;
};
/// Goes on to the next collision of disks and halts there.
struct StepCollision {};
/// Simulation time per second of real time, > 0.
struct SetSpeed {
  double speed = 1.0;
};
/// Laws that hold from now on, see Schedule.
struct SetLaws {
  std::vector<Override> laws;
};
/// Shows the view's field from now on.
struct Show {
  View view;
};
/// Starts a scene, and plays it or halts there: from its beginning, or from as much of the gas
/// that there is as fits, see refitted().
struct Open {
  Scene scene;
  std::uint64_t seed = 1;
  bool plays = true;
  bool keeps_gas = false;
};

}  // namespace command

using Command = std::variant<command::Play, command::Step, command::StepCollision,
                             command::SetSpeed, command::SetLaws, command::Show, command::Open>;

}  // namespace clatter
