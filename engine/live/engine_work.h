#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "engine/live/command.h"
#include "engine/live/command_queue.h"
#include "engine/live/event_rate.h"
#include "engine/live/frame.h"
#include "engine/live/gases_in_step.h"
#include "engine/live/opening_run.h"
#include "engine/live/pace.h"
#include "engine/live/played_stretch.h"
#include "engine/live/rewinder.h"
#include "engine/live/triple_buffer.h"

// The window's engine is a Worker, a thread that owns the run. A queue carries Commands to it, and
// TripleBuffer, a triple buffer, carries Frames back. Nothing else is shared, and neither side
// waits for the other. SlicedWorker is the same engine on the thread of a page. Both call
// EngineWork, which executes the commands (engine_commands.cpp), runs the gas in slices of a few
// milliseconds, and sends the frames. The thread sleeps when nothing moves. OpeningGases starts the
// runs of a scene in parts. Gases that are compared are runs in GasesInStep. The selected run
// leads: after each slice, the others run to its time. A frame has their frames in Frame::others,
// and frames_of returns all of them in order. Each run has the bits that it has alone, and a copy
// shares the recorded states of its original. A single gas is a GasesInStep with one run. The
// numbers of a frame come from RunWatch: the tally, the averages, the clicks, and the collisions of
// the picked particle. CollisionLookahead, a copy of the run that runs ahead, finds the next
// collision of a picked particle. render/picking.h finds the particle under the mouse, with the
// same images and cuts as the picture.

namespace clatter {

/// The work of the engine, on its thread or in slices. It executes commands, runs the gases at
/// their speed and publishes frames. Errors become messages in frames.
///
/// Its state is a motion and an errand. The motion is a halt, playing, playing backwards or a step.
/// An errand comes before the motion: a scene is opened, the last collision is searched for, or the
/// run goes to another time. Commands wait until the errand ends.
class EngineWork {
 public:
  using Clock = Pace::Clock;  ///< of real time

  /// Takes commands from a queue, and publishes frames in a buffer. After each frame it calls
  /// `on_publish`. The record of a run's past states has at most `record_bytes`.
  EngineWork(double frames_per_second, CommandQueue<Command>& commands, TripleBuffer<Frame>& frames,
             std::size_t record_bytes, std::function<void()> on_publish);

  /// Runs until the queue of commands is closed.
  void run();
  /// Does the work for a frame after the real time `elapsed` since the last one, until about `due`.
  void run_slice(Clock::duration elapsed, Clock::time_point due);
  /// Whether run_slice() has something to do without a command.
  bool busy() const { return moves() || has_errand() || looks_ahead(); }

 private:
  // Motions.
  struct Halted {};
  struct Playing {
    double until = std::numeric_limits<double>::infinity();  // simulation time
  };
  struct PlayingBackwards {
    std::optional<Rewinder> rewinder;  // absent: not begun yet, or ended by a command
    double shown = 0.0;                // simulation time of the last frame of the rewinder
    double wanted = 0.0;               // simulation time that the pace asked for last
  };
  struct Stepping {
    double to;  // simulation time
  };
  struct SteppingToCollision {
    std::uint64_t number;  // pair collisions at which to halt
  };

  // Errands.
  struct Searching {};
  struct Travelling {
    double to;                                                  // simulation time
    std::optional<std::array<std::uint32_t, 2>> partners = {};  // that have just collided there
    bool forward = false;                                       // to Open::at, with frames
  };

  template <class State>
  bool in() const {
    return std::holds_alternative<State>(motion_);
  }
  bool opens() const { return std::holds_alternative<OpeningGases>(errand_); }
  bool has_errand() const { return !std::holds_alternative<std::monostate>(errand_); }
  // The errand is in the past of the run.
  bool is_away() const { return has_errand() && !opens(); }
  bool moves() const { return gases_ && !in<Halted>(); }
  // A gas at rest has time to search for the next collision of the picked particle.
  bool looks_ahead() const { return gases_ && !moves() && gases_->looks_ahead(); }
  double time() const { return gases_->time(); }
  // In a tenth of a frame there is a time with few digits, for the scene file.
  double delay() const { return 0.1 * pace_.speed() * frame_seconds_; }

  void report(const std::string& message);
  void halt();
  template <class Act>
  bool attempt(const Act& act);

  // Commands.
  void execute_all();
  void abandon();
  void execute(const command::Play& asked);
  void execute(const command::PlayBackwards& asked);
  void execute(const command::Step& asked);
  void execute(const command::StepCollision& asked);
  void execute(const command::Jump& asked);
  void execute(const command::StepBack& asked);
  void execute(const command::MoveChange& asked);
  void execute(const command::ReplaceChanges& asked);
  void execute(const command::ExchangeFutures& asked);
  void execute(const command::Loop& asked);
  void execute(const command::SetSpeed& asked);
  void execute(const command::SetLaws& asked);
  void execute(const command::Nudge& asked);
  void execute(const command::AddPuff& asked);
  void execute(const command::Reverse& asked);
  void execute(const command::MovePiston& asked);
  void execute(const command::Show& asked);
  void execute(const command::ShowProfile& asked);
  void execute(const command::Listen& asked);
  void execute(const command::Pick& asked);
  void execute(const command::CopyGas& asked);
  void execute(const command::RemoveGas& asked);
  void execute(const command::SelectGas& asked);
  void execute(const command::Open& asked);
  void execute(const command::CancelOpen& asked);
  void leave_leader();

  std::optional<Clock::time_point> work(std::optional<Clock::time_point> slice_end);

  // Errands.
  void work_on_opening();
  void open_on();
  void finish_opening();
  bool search(const StopRequest& pause);
  bool travel(const StopRequest& pause);
  void go_on();
  void show_way();
  void go_to(double time);

  // Motions.
  void begin_rewind(PlayingBackwards& motion);
  bool rewind(PlayingBackwards& motion, double time, Clock::time_point due);
  void end_rewind();
  bool advance(double time, std::uint64_t collisions, Clock::time_point due);
  bool advance_heard(double time, Clock::time_point due);
  bool run_slices(double time, std::uint64_t collisions, Clock::time_point due);
  bool play(double goal, Clock::time_point due);
  void step(double seconds);
  void halt_at_collision();

  // Frames.
  void publish();
  void publish_rewound(Frame frame);
  void send_frame();

  CommandQueue<Command>& commands_;
  TripleBuffer<Frame>& frames_;
  std::function<void()> on_publish_;
  std::size_t record_bytes_;
  double frame_seconds_;
  Pace pace_;
  std::unique_ptr<GasesInStep> gases_;
  std::deque<Command> waiting_;  // commands that were not executed yet
  command::ShowProfile profiled_ = {.what = Profiled::Nothing};
  PlayedStretches played_;
  std::variant<Halted, Playing, PlayingBackwards, Stepping, SteppingToCollision> motion_;
  std::variant<std::monostate, OpeningGases, Searching, Travelling> errand_;
  Clock::time_point way_shown_;                           // last frame of the way to Open::at
  std::optional<std::array<double, 2>> loop_;             // repeated simulation times
  std::optional<std::array<std::uint32_t, 2>> partners_;  // of the collision just now
  std::uint64_t slice_ = 256;                             // steps per slice, adapted while running
  std::uint64_t runs_ = 0;
  std::uint64_t ids_ = 0;  // Frame::id of the last gas
  std::uint64_t handled_ = 0;
  std::string stop_;  // see Frame
  std::string message_;
  std::uint64_t messages_ = 0;
  EventRate rate_;
};

// Returns whether `act` succeeded. On an error (user error, physical stop, lack of memory) the
// frame gets a message, and the gas remains as before.
template <class Act>
bool EngineWork::attempt(const Act& act) {
  try {
    act();
    return true;
  } catch (const std::exception& error) {
    report(error.what());
    return false;
  }
}

}  // namespace clatter
