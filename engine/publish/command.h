#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// Content of the profile along an axis that a frame carries.
enum class Profiled { Nothing, Fields, Balances };

/// Commands of the user to a running gas.
namespace command {

/// Plays the run, up to a time at which it halts automatically; or halts it now.
struct Play {
  bool on = true;
  double until = std::numeric_limits<double>::infinity();  ///< simulation time
};
/// Runs for a duration and halts.
struct Step {
  double duration = 0.0;
};
/// Runs to the next collision of particles and halts.
struct StepCollision {};
/// Sets the simulation time per second of real time, > 0.
struct SetSpeed {
  double speed = 1.0;
};
/// Changes laws from a time on that follows within a tenth of a frame, see Schedule.
struct SetLaws {
  std::vector<Override> laws;
};
/// Shows the averages, flights and spins of this view from now on.
struct Show {
  View view;
};
/// Selects the profile of frames from now on.
struct ShowProfile {
  Profiled what = Profiled::Fields;
  Axis axis = Axis::X;
};
/// Selects the particle whose collisions frames contain from now on; absent: none.
struct Pick {
  std::optional<std::uint32_t> particle;
};
/// Opens a scene, playing or halted. The gas starts as the scene describes, or keeps as many
/// current particles as fit, see adapt_to_scene(). A gas of another dimension is not kept.
struct Open {
  Scene scene;
  std::uint64_t seed = 1;
  bool plays = true;
  bool keeps_gas = false;
  VecX shift = {};  ///< displacement of the kept particles; empty: none
};

/// Abandons the scene that is being opened, and the commands after its Open. The former gas
/// remains.
struct CancelOpen {};

}  // namespace command

using Command =
    std::variant<command::Play, command::Step, command::StepCollision, command::SetSpeed,
                 command::SetLaws, command::Show, command::ShowProfile, command::Pick,
                 command::Open, command::CancelOpen>;

}  // namespace clatter
