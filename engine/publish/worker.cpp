#include "engine/publish/worker.h"

#include <algorithm>
#include <deque>
#include <exception>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "engine/error.h"
#include "engine/initial/adapt_to_scene.h"
#include "engine/physics/temperature.h"
#include "engine/publish/gases_in_step.h"
#include "engine/publish/opening_run.h"
#include "engine/publish/pace.h"
#include "engine/publish/rewinder.h"

namespace clatter {

namespace {

// Whether two commands set the same laws or the time, so that only the later one counts. The user
// may drag a slider or the timeline faster than a large gas can follow.
bool supersedes(const Command& later, const Command& earlier) {
  using command::Jump;
  if (std::holds_alternative<Jump>(later) && std::holds_alternative<Jump>(earlier)) return true;
  const auto* a = std::get_if<command::SetLaws>(&later);
  const auto* b = std::get_if<command::SetLaws>(&earlier);
  return a && b && std::ranges::equal(a->laws, b->laws, {}, &Override::key, &Override::key);
}

}  // namespace

// The work of the engine, on its thread or in slices.
class EngineWork {
  using Clock = Pace::Clock;

 public:
  EngineWork(double frames_per_second, CommandQueue<Command>& commands, TripleBuffer<Frame>& frames,
             std::size_t record_bytes, std::function<void()> on_publish)
      : commands_(commands),
        frames_(frames),
        on_publish_(std::move(on_publish)),
        record_bytes_(record_bytes),
        frame_seconds_(1.0 / frames_per_second),
        pace_(frames_per_second) {}

  // Runs until the queue of commands is closed.
  void run() {
    while (!commands_.closed()) {
      obey_all();
      if (opening_) {
        open_on();
      } else if (goes()) {
        go_on();
      } else if (looks_ahead()) {
        publish();
      } else if (!moves()) {
        commands_.wait();
      } else if (backwards_) {
        begin_rewind();
        const Pace::Goal goal = pace_.next(Clock::now(), -wanted_);
        if (rewind(-goal.time, goal.due)) commands_.wait_until(goal.due);
      } else if (plays_) {
        const Pace::Goal goal = pace_.next(Clock::now(), time());
        if (play(goal.time, goal.due)) commands_.wait_until(goal.due);
      } else {
        step(frame_seconds_);
      }
    }
  }

  // Does the work for a frame after the real time `elapsed` since the last one, until about `due`.
  void run_slice(Clock::duration elapsed, Clock::time_point due) {
    const bool opened = opens();
    obey_all();
    if (opens()) {
      // A new opening has already had its slice.
      if (opened) open_on();
      return;
    }
    if (goes()) return go_on();
    if (looks_ahead()) return publish();
    if (!moves()) return;
    if (backwards_) {
      begin_rewind();
      pace_.set_frame(elapsed);
      rewind(-pace_.next(Clock::now(), -wanted_).time, due);
    } else if (plays_) {
      pace_.set_frame(elapsed);
      play(pace_.next(Clock::now(), time()).time, due);
    } else {
      step(std::chrono::duration<double>(due - Clock::now()).count());
    }
  }

  bool busy() const { return moves() || opens() || goes() || looks_ahead(); }

 private:
  // Scenes that are being opened.
  struct Opening {
    command::Open asked;
    std::vector<std::unique_ptr<OpeningRun>> runs = {};
    bool complete = false;

    bool advance(const StopRequest& pause) {
      return std::ranges::all_of(runs, [&](auto& run) { return run->advance(pause); });
    }
    double progress() const {
      double sum = 0.0;
      for (const auto& run : runs) sum += run->progress();
      return sum / static_cast<double>(runs.size());
    }
  };

  bool moves() const { return gases_ && (plays_ || step_to_ || to_collision_); }
  bool opens() const { return opening_.has_value(); }
  bool goes() const { return searches_ || going_to_; }
  // A gas at rest has time to search for the next collision of the picked particle.
  bool looks_ahead() const { return gases_ && !moves() && gases_->looks_ahead(); }

  // Commands wait while a scene is being opened, and while the run is on its way to another time.
  void obey_all() {
    std::vector<Command> asked = commands_.take();
    bool any = !asked.empty();
    std::ranges::move(asked, std::back_inserter(waiting_));
    if (opening_) abandon();
    if (any && rewinder_) attempt([this] { end_rewind(); });
    if (goes() && !waiting_.empty() && std::holds_alternative<command::Jump>(waiting_.front())) {
      stay();
    }
    while (!opening_ && !goes() && !waiting_.empty() && !commands_.closed()) {
      const Command next = std::move(waiting_.front());
      waiting_.pop_front();
      any = true;
      if (waiting_.empty() || !supersedes(waiting_.front(), next)) {
        attempt([&] { std::visit([this](const auto& command) { obey(command); }, next); });
      }
      if (!opening_) ++handled_;
    }
    if (any && !goes()) publish();
  }

  // Another scene, or CancelOpen, ends the opening and the commands between.
  void abandon() {
    const auto ends = [](const Command& command) {
      const auto* open = std::get_if<command::Open>(&command);
      return (open && !open->keeps_gas) || std::holds_alternative<command::CancelOpen>(command);
    };
    const auto last = std::ranges::find_if(waiting_.rbegin(), waiting_.rend(), ends).base();
    if (last == waiting_.begin()) return;
    opening_.reset();
    handled_ += static_cast<std::uint64_t>(last - waiting_.begin());
    waiting_.erase(waiting_.begin(), last - 1);
  }

  double time() { return gases_->time(); }

  // In a tenth of a frame there is a time with few digits, for the scene file.
  double delay() const { return 0.1 * pace_.speed() * frame_seconds_; }

  void tell(const std::string& message) {
    message_ = message;
    ++messages_;
  }

  void halt() {
    plays_ = backwards_ = false;
    step_to_.reset();
    to_collision_.reset();
    partners_.reset();
    pace_.restart();
  }

  // Returns whether `act` succeeded. On an error (user error, physical stop, lack of memory) the
  // frame gets a message, and the gas remains as before.
  template <class Act>
  bool attempt(const Act& act) {
    try {
      act();
      return true;
    } catch (const std::exception& error) {
      tell(error.what());
      return false;
    }
  }

  void obey(const command::Play& asked) {
    halt();
    plays_ = asked.on;
    until_ = asked.until;
    if (gases_ && !plays_) gases_->settle();
  }
  void obey(const command::PlayBackwards&) {
    halt();
    plays_ = backwards_ = gases_ && time() > 0.0;
  }
  void obey(const command::Step& asked) {
    halt();
    if (gases_) step_to_ = time() + asked.duration;
  }
  void obey(const command::StepCollision&) {
    halt();
    if (gases_) to_collision_ = gases_->counts().pair_collisions + 1;
  }
  void obey(const command::Jump& asked) {
    halt();
    if (gases_) go_to(std::clamp(asked.time, 0.0, gases_->head()));
  }
  void obey(const command::StepBack&) {
    halt();
    searches_ = gases_ != nullptr;
  }
  void obey(const command::MoveChange& asked) {
    halt();
    if (gases_) going_to_ = gases_->move_change(asked.number, asked.time);
  }
  void obey(const command::ReplaceChanges& asked) {
    halt();
    if (gases_) going_to_ = gases_->replace_changes(asked.changes, asked.from);
  }
  void obey(const command::ExchangeFutures&) {
    halt();
    if (gases_) going_to_ = gases_->exchange_futures();
  }
  void obey(const command::Loop& asked) {
    loop_.reset();
    if (asked.from < asked.to) loop_ = {asked.from, asked.to};
  }
  void obey(const command::SetSpeed& asked) { pace_.set_speed(asked.speed); }
  void obey(const command::SetLaws& asked) {
    ++laws_;
    if (gases_) gases_->change(asked.laws, delay());
  }
  void obey(const command::Nudge& asked) {
    if (gases_) gases_->nudge(asked.nudge, delay());
  }
  void obey(const command::AddPuff& asked) {
    if (gases_) gases_->puff(asked.puff, delay());
  }
  void obey(const command::MovePiston& asked) {
    if (gases_) gases_->move_piston(asked.position, asked.duration, delay());
  }
  void obey(const command::Show& asked) {
    if (gases_) gases_->show(asked.view);
  }
  void obey(const command::ShowProfile& asked) {
    profiled_ = asked;
    if (gases_) gases_->show_profile(asked.what, asked.axis);
  }
  void obey(const command::Listen& asked) {
    listens_ = asked.on;
    played_.clear();
    if (gases_) gases_->listen(listens_);
  }
  void obey(const command::Pick& asked) {
    if (gases_) gases_->pick(asked.particle);
  }
  void obey(const command::CopyGas&) {
    if (gases_) gases_->add_copy(++ids_);
  }
  void obey(const command::RemoveGas& asked) {
    if (!gases_) return;
    leave_leader();
    gases_->remove(asked.gas);
  }
  void obey(const command::SelectGas& asked) {
    if (!gases_) return;
    leave_leader();
    gases_->select(asked.gas);
  }
  void obey(const command::Open& asked) {
    std::vector<command::GasToOpen> gases = asked.beside;
    const std::size_t place = std::min(asked.gas, gases.size());
    gases.insert(gases.begin() + static_cast<std::ptrdiff_t>(place), {asked.scene, asked.seed});
    Opening opening{asked};
    for (std::size_t k = 0; k < gases.size(); ++k) {
      command::GasToOpen& gas = gases[k];
      if (asked.keeps_gas && gases_ && k < gases_->count()) {
        const VecX shift = k == place ? asked.shift : VecX();
        AnyState state = gases_->state_of(k);
        std::visit([&](auto& present) { start_from(present, shift, gas.seed, gas.scene); }, state);
      }
      opening.runs.push_back(std::make_unique<OpeningRun>(gas.scene, gas.seed, record_bytes_));
    }
    opening_.emplace(std::move(opening));
    if (work_on_opening()) finish_opening();
  }
  void obey(const command::CancelOpen&) {}

  // Ends what counts the events of the selected gas, before another one is selected.
  void leave_leader() {
    if (to_collision_) halt();
    partners_.reset();
    rate_since_ = {};
  }

  // Continues the opening for a slice of time. Returns whether it is complete.
  bool work_on_opening() {
    constexpr std::chrono::milliseconds kSlice{20};
    const auto due = Clock::now() + kSlice;
    bool complete = false;
    const bool possible = attempt([&] {
      complete = opening_->advance([&] { return Clock::now() >= due || commands_.pending(); });
    });
    if (!possible) opening_.reset();
    return complete;
  }

  // A slice of the opening, after which the other commands follow. The first frame of the run has a
  // slice of its own, because its picture takes long.
  void open_on() {
    if (opening_->complete) {
      attempt([this] { finish_opening(); });
    } else if (work_on_opening()) {
      opening_->complete = true;
    }
    if (!opening_) {
      ++handled_;
      obey_all();
    }
    publish();
  }

  void finish_opening() {
    Opening opening = *std::exchange(opening_, std::nullopt);
    const command::Open& asked = opening.asked;
    halt();
    std::vector<std::unique_ptr<WatchedRun>> runs;
    std::vector<std::uint64_t> ids;
    for (const auto& run : opening.runs) {
      runs.push_back(run->take());
      ids.push_back(++ids_);
    }
    gases_ = std::make_unique<GasesInStep>(std::move(runs), std::move(ids),
                                           std::min(asked.gas, asked.beside.size()));
    gases_->show_profile(profiled_.what, profiled_.axis);
    gases_->listen(listens_);
    ++laws_;
    pace_.set_speed(asked.scene.view.speed);
    pace_.set_factors(asked.scene.view.pace);
    plays_ = asked.plays;
    until_ = std::numeric_limits<double>::infinity();
    ++runs_;
    loop_.reset();
    stop_.clear();
    rate_since_ = {};
  }

  // Begins the way to a time of the run so far.
  void go_to(double time) {
    gases_->go_back(time);
    going_to_ = time;
  }

  // Ends the way to another time, wherever the run is.
  void stay() {
    searches_ = false;
    going_to_.reset();
    partners_there_.reset();
  }

  // A slice of the way to another time. Frames follow at its end.
  void go_on() {
    constexpr std::chrono::milliseconds kSlice{20};
    const auto due = Clock::now() + kSlice;
    const auto pauses = [&] { return Clock::now() >= due || commands_.pending(); };
    rate_since_ = {};
    stop_.clear();
    const bool possible = attempt([&] {
      if (searches_) {
        if (!gases_->search_back(pauses)) return;
        searches_ = false;
        const std::optional<PreviousCollision> collision = gases_->previous_collision();
        if (collision) partners_there_ = collision->partners;
        go_to(collision ? collision->time : 0.0);
      }
      if (!gases_->prepare(pauses)) return;
      while (time() < *going_to_ && !gases_->run_until(*going_to_, kNoLimit, kNoLimit, pauses)) {
        if (pauses()) return;
      }
      if (partners_there_) partners_ = partners_there_;
      stay();
    });
    if (!possible) stay();
    if (goes()) return;
    pace_.restart();
    publish();
    obey_all();
  }

  void begin_rewind() {
    if (rewinder_) return;
    shown_ = wanted_ = time();
    rewinder_.emplace(*gases_, pace_.speed() * frame_seconds_);
  }

  // Brings the run to the time of the shown frame.
  void end_rewind() {
    if (!rewinder_) return;
    rewinder_.reset();
    go_to(shown_);
  }

  // Shows the frame at a time, and then makes earlier ones, until the real time `due` or the next
  // command. Returns whether it has time left. If the frame is late, the delay is dropped.
  bool rewind(double time, Clock::time_point due) {
    const auto late = [&] { return Clock::now() >= due || commands_.pending(); };
    const auto in_time = [&] { return !late(); };
    std::optional<Frame> frame;
    const bool works = attempt([&] {
      const bool asked = rewinder_->due(time);
      while (asked && !(frame = rewinder_->take(time)) && in_time()) rewinder_->work(late);
      wanted_ = asked && !frame ? shown_ : time;
      if (frame) shown_ = frame->snapshot.time;
      if (frame && shown_ > 0.0) publish_rewound(std::move(*frame));
      while (rewinder_->busy() && in_time()) rewinder_->work(late);
    });
    if (!works || shown_ == 0.0) {
      halt();
      attempt([this] { end_rewind(); });
      if (!goes()) publish();
    }
    return backwards_ && in_time();
  }

  // Makes a gas, moved by a shift, the start state of another scene.
  template <int D>
  static void start_from(State<D>& state, const VecX& shift, std::uint64_t seed, Scene& scene) {
    if (scene.dimension() != D) return;
    if (shift.size() > 0) {
      for (Vec<D>& position : state.positions) position += shift;
    }
    state = adapt_to_scene(state, scene, seed);
    const double temperature = temperature_of(state);
    scene.particles.start = {
        .layout = Layout::File, .file = "", .state = std::move(state), .temperature = temperature};
  }

  // Runs up to `time`, but at most until the real time `due` or the next command. Returns whether
  // it reached `time`.
  bool advance(double time, std::uint64_t collisions, Clock::time_point due) {
    bool arrived = false;
    stop_.clear();
    if (!attempt([&] { arrived = run_slices(time, collisions, due); })) {
      halt();
      stop_ = message_;
    }
    return arrived;
  }

  // The same for a gas that plays, whose clicks are kept for listeners.
  bool advance_heard(double time, Clock::time_point due) {
    if (!listens_) return advance(time, kNoLimit, due);
    constexpr double kLeastHeld = 0.01;
    gases_->take_clicks();  // of the way to the present time, which nobody hears
    const double from = this->time();
    const bool arrived = advance(time, kNoLimit, due);
    if (played_.size() == kMostStretches) played_.erase(played_.begin());
    played_.push_back(std::make_shared<const PlayedStretch>(PlayedStretch{
        ++stretches_, from, this->time(), pace_.speed_at(from) * std::max(kLeastHeld, pace_.held()),
        laws_, gases_->take_clicks()}));
    return arrived;
  }

  bool run_slices(double time, std::uint64_t collisions, Clock::time_point due) {
    constexpr std::chrono::milliseconds kSlice{2};
    for (;;) {
      const auto began = Clock::now();
      const EventCounts& counts = gases_->counts();
      const bool arrived = gases_->run_until(time, collisions, counts.steps() + slice_);
      const bool collided = gases_->counts().collisions() >= collisions;
      if (arrived || collided) return arrived;
      // A slice that ends early says nothing about the cost of its steps.
      const auto now = Clock::now();
      slice_ = now - began < kSlice ? 2 * slice_ : std::max<std::uint64_t>(1, slice_ / 2);
      slice_ = std::min(slice_, kLongestSlice);
      if (now >= due || commands_.pending()) return false;
    }
  }

  // Runs up to `goal`, but at most until about `due`. Returns whether it arrived and still plays.
  bool play(double goal, Clock::time_point due) {
    const bool repeats = loop_ && time() < (*loop_)[1];
    const double end = repeats ? std::min(until_, (*loop_)[1]) : until_;
    const bool arrived = advance_heard(std::min(goal, end), due);
    if (arrived && time() >= until_) {
      halt();
    } else if (arrived && repeats && goal >= end) {
      pace_.restart();
      if (!attempt([this] { go_to((*loop_)[0]); })) halt();
    }
    if (!goes()) publish();
    return arrived && plays_;
  }

  // Runs at full speed for some seconds of real time, before a frame.
  void step(double seconds) {
    const auto due = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(seconds));
    if (step_to_) {
      if (advance(*step_to_, kNoLimit, due)) halt();
    } else {
      const double ahead = time() + pace_.speed() * frame_seconds_;
      while (to_collision_ && time() < ahead && Clock::now() < due && !commands_.pending()) {
        advance(ahead, gases_->counts().collisions() + 1, due);
        const std::uint64_t collisions = gases_->counts().pair_collisions;
        if (to_collision_ && collisions >= *to_collision_) halt_at_collision();
      }
    }
    publish();
  }

  void halt_at_collision() {
    halt();
    partners_ = gases_->partners();
    attempt([this] { gases_->settle(); });
  }

  void publish() {
    if (gases_ && !attempt([&] { gases_->tell(frames_.back(), !moves()); })) halt();
    send_frame();
  }

  void publish_rewound(Frame frame) {
    frames_.back() = std::move(frame);
    send_frame();
  }

  // Sends the next frame, with the state of the engine.
  void send_frame() {
    Frame& frame = frames_.back();
    frame.opening.reset();
    if (opening_) frame.opening = opening_->progress();
    frame.run = runs_;
    frame.handled = handled_;
    frame.plays = plays_;
    frame.backwards = backwards_;
    frame.loop = loop_;
    frame.speed = pace_.speed();
    for (Frame& beside : frame.beside) {
      beside.run = runs_;
      beside.speed = pace_.speed();
    }
    frame.held = pace_.held();
    frame.events_per_second = event_rate();
    frame.partners = partners_;
    frame.played = played_;
    frame.stop = stop_;
    frame.message = message_;
    frame.messages = messages_;
    frames_.publish();
    on_publish_();
  }

  // Collisions per second of real time over about the last half second.
  double event_rate() {
    constexpr std::chrono::milliseconds kLong{500};
    if (!plays_ || backwards_ || !gases_) return rate_ = 0.0;
    const auto now = Clock::now();
    const std::uint64_t events = gases_->counts().collisions();
    if (rate_since_ == Clock::time_point{}) {
      rate_since_ = now;
      events_then_ = events;
    } else if (now - rate_since_ > kLong) {
      rate_ = static_cast<double>(events - events_then_) /
              std::chrono::duration<double>(now - rate_since_).count();
      rate_since_ = now;
      events_then_ = events;
    }
    return rate_;
  }

  static constexpr std::uint64_t kLongestSlice = 1u << 20;

  CommandQueue<Command>& commands_;
  TripleBuffer<Frame>& frames_;
  std::function<void()> on_publish_;
  std::size_t record_bytes_;
  double frame_seconds_;
  Pace pace_;
  std::unique_ptr<GasesInStep> gases_;
  std::optional<Opening> opening_;
  std::deque<Command> waiting_;  // commands that were not obeyed yet
  command::ShowProfile profiled_ = {.what = Profiled::Nothing};
  bool listens_ = false;
  std::uint64_t stretches_ = 0;  // PlayedStretch::number of the last one
  std::uint64_t laws_ = 0;       // PlayedStretch::laws
  std::vector<std::shared_ptr<const PlayedStretch>> played_;  // see Frame
  bool plays_ = false;
  bool backwards_ = false;            // plays_ backwards
  std::optional<Rewinder> rewinder_;  // while it plays backwards
  double shown_ = 0.0;                // simulation time of the last frame of the rewinder
  double wanted_ = 0.0;               // simulation time that the pace asked for last
  double until_ = std::numeric_limits<double>::infinity();  // simulation time of the automatic halt
  std::optional<std::array<double, 2>> loop_;               // repeated simulation times
  std::optional<double> step_to_;
  bool searches_ = false;           // on the way to the last collision
  std::optional<double> going_to_;  // simulation time that the run is on its way to
  std::optional<std::array<std::uint32_t, 2>> partners_there_;  // that have just collided there
  std::optional<std::uint64_t> to_collision_;  // number of pair collisions at which to halt
  std::optional<std::array<std::uint32_t, 2>> partners_;
  std::uint64_t slice_ = 256;  // steps per slice, adapted while running
  std::uint64_t runs_ = 0;
  std::uint64_t ids_ = 0;  // Frame::id of the last gas
  std::uint64_t handled_ = 0;
  std::string stop_;  // see Frame
  std::string message_;
  std::uint64_t messages_ = 0;
  double rate_ = 0.0;
  Clock::time_point rate_since_{};
  std::uint64_t events_then_ = 0;
};

static constexpr double kFramesOfSlices = 60.0;  // per second; a single step has this duration
static constexpr std::size_t kRecordBytesOfSlices = kRecordBytes / 4;  // a page has less memory

SlicedWorker::SlicedWorker()
    : work_(std::make_unique<EngineWork>(kFramesOfSlices, commands_, frames_, kRecordBytesOfSlices,
                                         [] {})) {}

SlicedWorker::~SlicedWorker() = default;

void SlicedWorker::work(std::chrono::milliseconds budget) {
  constexpr std::chrono::milliseconds kLongest{100};
  const auto now = Pace::Clock::now();
  const auto elapsed = std::min<Pace::Clock::duration>(now - std::exchange(last_, now), kLongest);
  work_->run_slice(elapsed, now + budget);
}

bool SlicedWorker::busy() {
  return commands_.pending() || work_->busy();
}

Worker::Worker(double frames_per_second, std::function<void()> on_publish)
    : thread_([this, frames_per_second, on_publish = std::move(on_publish)] {
        work(frames_per_second, on_publish);
      }) {}

Worker::~Worker() {
  commands_.close();
  thread_.join();
}

void Worker::work(double frames_per_second, const std::function<void()>& on_publish) {
  EngineWork(frames_per_second, commands_, frames_, kRecordBytes, on_publish).run();
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ended_changed_.notify_one();
}

bool Worker::stop_within(std::chrono::milliseconds time) {
  commands_.close();
  std::unique_lock lock(mutex_);
  return ended_changed_.wait_for(lock, time, [this] { return ended_; });
}

}  // namespace clatter
