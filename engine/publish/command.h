#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// What a frame may have a profile of, along x.
enum class Profiled { Nothing, Fields, Balances };

/// What a person asks of a gas that runs.
namespace command {

/// Lets simulation time go on, up to a time where it halts of itself; or halts it now.
struct Play {
  bool on = true;
  double until = std::numeric_limits<double>::infinity();  ///< simulation time
};
/// Goes on by a time and halts there.
struct Step {
  double duration = 0.0;
};
/// Goes on to the next collision of particles and halts there.
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
/// What frames have profiles of from now on.
struct ShowProfile {
  Profiled what = Profiled::Fields;
};
/// Frames tell the collisions of this particle from now on; absent: of none.
struct Pick {
  std::optional<std::uint32_t> particle;
};
/// Starts a scene, and plays it or halts there: from its beginning, or from as much of the gas
/// that there is as fits, see adapt_to_scene(); a gas of another dimension is not kept.
struct Open {
  Scene scene;
  std::uint64_t seed = 1;
  bool plays = true;
  bool keeps_gas = false;
  VecX shift = {};  ///< of the particles that are kept; empty: none
};

}  // namespace command

using Command = std::variant<command::Play, command::Step, command::StepCollision,
                             command::SetSpeed, command::SetLaws, command::Show,
                             command::ShowProfile, command::Pick, command::Open>;

}  // namespace clatter
