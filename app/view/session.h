#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/view/script_log.h"
#include "engine/publish/worker.h"

namespace clatter {

/// What a person changed at once, and can take back at once.
struct Edit {
  std::vector<Override> before = {};
  std::vector<Override> after = {};
  Vec2 shift = {0.0, 0.0};  ///< of the disks in the box that `after` makes; back by `before`
  std::optional<std::array<View, 2>> views = {};  ///< before and after; absent: no other view
};

/// The gas that a person watches, and what they have done to it. It asks the engine, and never
/// waits for it.
class Session {
 public:
  Session(Worker& worker, ScriptLog& log) : worker_(worker), log_(log) {}

  /// Takes the newest frame; whether there was one.
  bool update();
  /// The newest frame; its run is 0 until there is one.
  const Frame& frame() const { return worker_.frames().front(); }
  /// The scene with the laws as they are being set: what the panels show.
  const Scene& scene() const { return scene_; }
  /// The scene as it was opened.
  const Scene& opened() const { return opened_; }
  /// What is drawn.
  const View& view() const { return view_; }
  /// The scene from which what is on screen can be made again: as the gas was started, with all
  /// that has changed since, up to the newest frame. There must be a frame.
  Scene recorded() const;

  /// Starts a scene.
  void open(const Scene& scene, std::uint64_t seed, bool plays = true);
  /// Starts the scene anew with the laws as they are now.
  void restart();
  /// Likewise with other random numbers.
  void restart_with_new_seed();
  /// Lets the gas go on, or halts it.
  void play(bool on);
  /// Lets the gas go on up to a simulation time, where it halts.
  void play_until(double time);
  /// Goes on by the time between two frames at its speed, and halts.
  void step_frame();
  /// Goes on to the next collision of disks, and halts.
  void step_collision();
  /// Simulation time per second.
  void set_speed(double speed);

  /// Sets keys: laws on the gas that moves, others by starting anew with what fits of the gas once
  /// its disks are moved by `shift`. What cannot be is told.
  void set(const std::vector<Override>& settings, const Vec2& shift = Vec2::Zero());
  /// Keeps what has been set, to be taken back; forgets what was taken back before.
  void remember(Edit edit);
  /// Takes back what was remembered last.
  void undo();
  /// Sets again what was taken back last.
  void redo();

  /// Draws otherwise from now on; with another field its averages start anew, with trails the
  /// engine begins to keep the disks' flights.
  void set_view(const View& view);
  /// What frames have profiles of from now on.
  void show_profile(Profiled what);
  /// Frames tell the collisions of this disk from now on.
  void pick(std::optional<std::size_t> disk);
  /// How often the view has changed.
  std::uint64_t views() const { return views_; }

  /// Something to tell the person, until they have seen it.
  void tell(const std::string& message);
  /// What was told last; empty: nothing yet.
  const std::string& message() const { return message_; }
  /// Seconds since it was told.
  double message_age() const;

 private:
  using Clock = std::chrono::steady_clock;

  // What stays where the engine refuses the scene that is opened.
  struct Before {
    Scene opened;
    View view;
    std::uint64_t run = 0;
  };

  void answered(const Frame& now);
  void send(Command command);
  void apply(const Edit& edit, bool again);
  void refit(const Vec2& shift);

  Worker& worker_;
  ScriptLog& log_;
  Scene scene_;
  Scene opened_;
  View view_;
  std::uint64_t seed_ = 1;
  bool plays_ = true;
  Profiled profiled_ = Profiled::Nothing;
  std::optional<std::size_t> picked_;
  double speed_ = 1.0;
  std::uint64_t sent_ = 0;
  std::uint64_t handled_ = 0;
  std::uint64_t views_ = 0;
  std::shared_ptr<const Scene> seen_;
  bool wishes_ = false;           // whether scene_ has what the engine may refuse
  std::optional<Before> before_;  // a scene that is being opened
  std::uint64_t messages_ = 0;
  std::vector<Edit> done_;
  std::vector<Edit> undone_;
  std::string message_;
  Clock::time_point told_;
  Clock::time_point logged_;
};

}  // namespace clatter
