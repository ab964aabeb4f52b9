#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/view/script_log.h"
#include "engine/live/worker.h"

namespace clatter {

/// A scene with its settings, and as it was opened.
struct OpenedScene {
  Scene scene;
  Scene opened;
  std::uint64_t seed = 1;
  bool unsaved = false;  ///< see Session::unsaved()
};

/// One entry of the undo history.
struct Edit {
  std::size_t gas = 0;                ///< number of the changed gas
  std::vector<Override> before = {};  ///< keys that undo the change
  std::vector<Override> after = {};   ///< keys that make the change
  VecX shift = {};  ///< shift of the particles with `after`; undo shifts them back; empty: none
  std::optional<std::array<View, 2>> views = {};  ///< view before and after; absent: unchanged
  /// Scenes before and after, which start again; empty: no other scene.
  std::vector<OpenedScene> scenes = {};
  /// Number of the change in the past whose two futures the entry exchanges; 0: none.
  std::uint64_t fork = 0;
  /// Nudges, puffs and strokes of the piston that the entry made, without times; undo removes them
  /// from the run.
  std::vector<Change> acts = {};
  std::vector<Change> undone_acts = {};  ///< with their times
  bool made =
      false;  ///< whether the engine has made the change; an entry that it refuses is removed
};

/// The simulation in the window: its scene, its view and the undo history. It sends commands to the
/// engine and never waits for the engine.
///
/// Up to kMostGases gases are compared. They run in step with the same seed, view and speed. One of
/// them is selected: scene(), opened() and all changes are those of the selected gas.
class Session {
 public:
  Session(EngineLink& engine, ScriptLog& log) : engine_(engine), log_(log) {}

  /// Takes the newest frame. Returns true if there was a new one.
  bool update();
  /// The newest frame. Its run is 0 before the first frame.
  const Frame& frame() const { return engine_.frames().front(); }
  /// The scene with the latest settings, as the panels show it.
  const Scene& scene() const { return selected().scene; }
  /// The scene as it was opened.
  const Scene& opened() const { return selected().opened; }
  /// The current view.
  const View& view() const { return view_; }
  /// The scene that reproduces the run of a gas: its start, with all later changes. The window
  /// opens it at the time of the frame. Requires a frame of this gas.
  Scene recorded(const Frame& gas) const;

  /// Opens and starts a scene, at View::open_at, and those `beside` it in step, which get its view.
  /// Undo starts the former scene with its changes, without a comparison. Without `plays` the scene
  /// is paused.
  void open(const Scene& scene, std::uint64_t seed, bool plays = true,
            const std::vector<Scene>& others = {});
  /// Number of gases.
  std::size_t gases() const { return gases_.size(); }
  /// Number of the selected gas.
  std::size_t gas() const { return gas_; }
  /// Adds a copy of the selected gas as the last one, and selects it.
  void add_copy();
  /// Removes the selected gas, and its entries of the undo history. One gas remains.
  void remove_gas();
  /// Selects a gas.
  void select(std::size_t gas);
  /// Abandons the scene that is being opened. The former gas remains.
  void cancel_open();
  /// Restarts all gases with their current laws. A scene with scheduled changes restarts with the
  /// laws it was opened with.
  void restart();
  /// Starts the scene as it was opened. Undo starts it with its changes.
  void restore() { open(Scene(opened()), seed_, plays_); }
  /// Calls restart() with the next seed.
  void restart_with_new_seed();
  /// Starts the scene in the other dimension, with disks or spheres, see change_dimension(). Undo
  /// starts the former scene.
  void switch_dimension();
  /// Continues or pauses the simulation.
  void play(bool on);
  /// Plays the run backwards, to time 0 at most.
  void play_backwards();
  /// Continues the simulation up to a simulation time, and pauses it there.
  void play_until(double time);
  /// Advances the simulation by one frame at the current speed, and pauses it.
  void step_frame();
  /// Advances the simulation to the next collision of two particles, and pauses it.
  void step_collision();
  /// Goes to a simulation time of the run so far, and pauses there. Times outside become its ends.
  void jump(double time);
  /// Jumps by this many seconds of playing at the current speed, and plays on if it plays.
  void skip(double seconds);
  /// Repeats a stretch of time: jumps to its start and plays. A stretch without length ends the
  /// repetition.
  void repeat(double from, double to);
  /// Goes back by one frame at the current speed, and pauses the simulation.
  void step_frame_back();
  /// Goes back to the last collision of two particles before the picture, and pauses there.
  void step_collision_back();
  /// Jumps to the latest time of the run, and plays on if it plays.
  void go_to_head();
  /// Moves a change of laws to another time > 0 and pauses where the runs differ. `number` is its
  /// index in the scene.
  void move_change(std::size_t number, double time);
  /// Exchanges the future after the last change in the past with the one before it. Undo exchanges
  /// them again.
  void exchange_futures();
  /// Sets the speed, simulation time per second. It is clamped to 1e-4..1e6.
  void set_speed(double speed);
  /// Sets the speed to the next larger, or smaller, of the numbers 1, 2 and 5 times a power of ten.
  void change_speed(bool faster);

  /// Sets keys. Laws change in the running simulation. Other keys restart it from the current
  /// particles, moved by `shift`, without those that no longer fit. An invalid setting becomes a
  /// message. If no particle spins afterwards, the view shows no spins.
  bool set(const std::vector<Override>& settings, const VecX& shift = {});
  /// Changes the signs of all velocities and spins.
  void reverse();
  /// Nudges particles of the running or halted gas. An impossible nudge becomes a message.
  void nudge(const Nudge& nudge);
  /// Adds the particles of a puff to the running or halted gas. An impossible puff becomes a
  /// message.
  void add(const Puff& puff);
  /// Moves the piston, the right wall, to a position on the x axis in a duration, > 0, after its
  /// strokes that have begun.
  void move_piston(double position, double duration);
  /// Whether the newest frame follows from all commands so far.
  bool is_answered() const { return frame().handled == sent_; }
  /// Adds an entry to the undo history, and clears the redo history.
  void remember(Edit edit);
  /// Reverts the last entry of the undo history.
  void undo();
  /// Applies the last reverted entry again.
  void redo();

  /// Whether the window holds work that would be lost with the gas: changes of a scene that is not
  /// of the gallery, added particles, moved changes, and settings that make another scene. Live
  /// changes of a gallery scene are experiments.
  bool unsaved() const { return unsaved_; }
  /// The changes so far are in a file, or given up.
  void set_saved() { unsaved_ = false; }

  /// Sets the view. Another field restarts the averages. Trails make the engine record flights.
  void set_view(const View& view);
  /// Sets the profile in later frames.
  void show_profile(Profiled what, Axis axis);
  /// Later frames have the clicks of the gas that plays, or no longer.
  void listen(bool on);
  /// Whether frames have clicks.
  bool listens() const { return listens_; }
  /// Later frames contain the last and next collision of this particle; absent: of none.
  void pick(std::optional<std::size_t> particle);
  /// Number of changes of the view.
  std::uint64_t views() const { return views_; }

  /// Sets the message of the window.
  void report(const std::string& message);
  /// The last message; empty: none yet.
  const std::string& message() const { return message_; }
  /// Number of messages so far.
  std::uint64_t messages() const { return told_; }

 private:
  using Clock = std::chrono::steady_clock;

  // A gas: its scene with the latest settings, and as it was opened.
  struct Gas {
    Scene scene;
    Scene opened;
  };
  // State to restore if the engine refuses the scene being opened.
  struct Before {
    std::vector<Gas> gases;
    View view;
    std::uint64_t run = 0;
  };

  void answered(const Frame& now);
  void remove_refused(bool refused_scene);
  void note_work(bool lasts);
  void watch_heat();
  void send(Command command);
  void apply(Edit& edit, bool again);
  void note_fork();
  bool must_wait(const std::vector<Edit>& edits);
  void forget_missing(std::vector<Edit>& edits) const;
  void exchange_acts(Edit& edit, bool again);
  void refit(const VecX& shift);
  void send_exchange();
  double present() const;
  void start(const OpenedScene& opened, const char* event, const std::vector<Scene>& others = {});
  void send_open(const Scene& scene, bool keeps_gas, const VecX& shift = {}, double at = 0.0);
  Scene as_shown(Scene scene) const;
  Scene restarted(const Gas& gas) const;
  OpenedScene present_scene() const;
  const Gas& selected() const { return gases_[gas_]; }
  Gas& selected() { return gases_[gas_]; }

  EngineLink& engine_;
  ScriptLog& log_;
  std::vector<Gas> gases_{1};
  std::size_t gas_ = 0;  // the selected one
  View view_;
  std::uint64_t seed_ = 1;
  bool plays_ = true;
  std::optional<double> jumped_to_;  // until the engine has answered
  command::ShowProfile profiled_ = {.what = Profiled::Nothing};
  bool listens_ = false;
  std::optional<std::size_t> picked_;
  double speed_ = 1.0;
  std::uint64_t sent_ = 0;
  std::uint64_t handled_ = 0;
  std::uint64_t views_ = 0;
  std::vector<std::shared_ptr<const Scene>> seen_;  // of the gases
  bool wishes_ = false;           // a scene has settings that the engine may refuse
  std::optional<Before> before_;  // state before the scene being opened; absent: none
  std::uint64_t messages_ = 0;    // Frame::messages of the last frame
  std::vector<Edit> done_;
  std::vector<Edit> undone_;
  void (Session::*postponed_)() = nullptr;  // undo() or redo() that waits for the engine
  std::uint64_t forks_ = 0;  // changes in the past; the last one has the present two futures
  bool unsaved_ = false;     // work that no file has
  bool own_ = false;         // the opened scene is not of the gallery
  std::uint64_t heated_run_ = 0;  // the run of heat_limit_
  double heat_limit_ = 0.0;  // temperature that is reported; 0: it was, or the gas started at rest
  bool forked_ = false;      // since the last entry of the undo history
  std::string message_;
  std::uint64_t told_ = 0;
  Clock::time_point logged_;
};

}  // namespace clatter
