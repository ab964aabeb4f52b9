#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// Content of the profile along an axis that a frame carries.
enum class Profiled { Nothing, Fields, Balances };

/// Largest number of gases that run in step.
inline constexpr std::size_t kMostGases = 4;

/// Commands of the user to the running gas, or to the gases that run in step.
namespace command {

/// Plays the run, up to a time at which it halts automatically; or halts it now.
struct Play {
  bool on = true;
  double until = std::numeric_limits<double>::infinity();  ///< simulation time
};
/// Repeats a stretch of the run from now on: a gas that plays goes from its end to its start. A
/// stretch without length repeats nothing.
struct Loop {
  double from = 0.0;  ///< simulation times, 0 <= from <= to
  double to = 0.0;
};
/// Plays the run backwards, and halts at time 0.
struct PlayBackwards {};
/// Runs for a duration and halts.
struct Step {
  double duration = 0.0;
};
/// Runs to the next collision of particles and halts.
struct StepCollision {};
/// Goes to a simulation time from 0 to Frame::head, and halts there. Other times become the nearest
/// of these.
struct Jump {
  double time = 0.0;
};
/// Goes back to the last collision of particles before the present state, and halts just after it.
/// Without one it goes to time 0.
struct StepBack {};
/// Moves a change to another time, see WatchedRun::move_change(), and halts.
struct MoveChange {
  std::size_t number = 0;  ///< index into Scene::changes
  double time = 0.0;       ///< simulation time > 0; a ramp or stroke keeps its duration
};
/// Gives the run other changes from a simulation time > 0 on, see WatchedRun::replace_changes(),
/// and halts.
struct ReplaceChanges {
  std::vector<Change> changes;
  double from = 0.0;
};
/// Exchanges the future after the last change in the past with the one before that change, and
/// halts.
struct ExchangeFutures {};
/// Sets the simulation time per second of real time, > 0.
struct SetSpeed {
  double speed = 1.0;
};
/// Changes laws from a time on that follows within a tenth of a frame, see Schedule. In the past it
/// begins another future, see WatchedRun::change.
struct SetLaws {
  std::vector<Override> laws;
};
/// Nudges particles, like a change of laws. Each nudge counts, also of many at once.
struct Nudge {
  clatter::Nudge nudge;
};
/// Adds as many particles of a puff as find room. Each puff counts, like a nudge.
struct AddPuff {
  Puff puff;
};
/// Changes the signs of all velocities and spins. Each counts, like a nudge.
struct Reverse {};
/// Moves the piston to a position on the x axis in a duration > 0, after its strokes that have
/// begun. Each stroke counts, like a nudge.
struct MovePiston {
  double position = 0.0;
  double duration = 0.0;  ///< simulation time
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
/// Records the collisions of the selected gas from now on, for its sound, or ends that.
struct Listen {
  bool on = true;
};
/// Selects the particle whose collisions frames contain from now on; absent: none.
struct Pick {
  std::optional<std::uint32_t> particle;
};
/// Adds a copy of the selected gas as the last one, in step with it and with the same past.
/// Impossible with kMostGases gases.
struct CopyGas {};
/// Removes a gas, but not the only one. Later numbers move down. If the selected gas is removed,
/// the one before it is selected.
struct RemoveGas {
  std::size_t gas = 0;
};
/// Selects the gas that commands about one gas change from now on: laws, nudges, puffs, strokes,
/// futures, picks and Open::scene. A number without a gas selects none other.
struct SelectGas {
  std::size_t gas = 0;
};
/// A scene and its seed.
struct GasToOpen {
  Scene scene;
  std::uint64_t seed = 1;
};
/// Opens a scene, playing or halted. The gas starts as the scene describes, or keeps as many
/// current particles as fit, see adapt_to_scene(). A gas of another dimension is not kept. The
/// scene replaces all gases. The `others` start in step with it, or each keeps the particles of the
/// gas with its number.
struct Open {
  Scene scene;
  std::uint64_t seed = 1;
  bool plays = true;
  bool keeps_gas = false;
  VecX shift = {};                     ///< displacement of the scene's kept particles; empty: none
  std::vector<GasToOpen> others = {};  ///< the other gases, in order of their numbers
  std::size_t gas = 0;                 ///< number of the scene's gas, which is selected
  double at = 0.0;                     ///< simulation time >= 0 to which the gas goes at once
};

/// Abandons the scene that is being opened, and the commands after its Open. The former gas
/// remains. Also ends the way to Open::at, at the time that the gas has reached.
struct CancelOpen {};

}  // namespace command

using Command =
    std::variant<command::Play, command::PlayBackwards, command::Step, command::StepCollision,
                 command::Jump, command::StepBack, command::ExchangeFutures, command::MoveChange,
                 command::ReplaceChanges, command::Loop, command::SetSpeed, command::SetLaws,
                 command::Nudge, command::AddPuff, command::Reverse, command::MovePiston,
                 command::Show, command::ShowProfile, command::Listen, command::Pick,
                 command::CopyGas, command::RemoveGas, command::SelectGas, command::Open,
                 command::CancelOpen>;

}  // namespace clatter
