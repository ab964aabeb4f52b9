#include "engine/live/engine_work.h"

#include <algorithm>
#include <utility>

#include "engine/error.h"

namespace clatter {

EngineWork::EngineWork(double frames_per_second, CommandQueue<Command>& commands,
                       TripleBuffer<Frame>& frames, std::size_t record_bytes,
                       std::function<void()> on_publish)
    : commands_(commands),
      frames_(frames),
      on_publish_(std::move(on_publish)),
      record_bytes_(record_bytes),
      frame_seconds_(1.0 / frames_per_second),
      pace_(frames_per_second) {}

void EngineWork::run() {
  while (!commands_.closed()) {
    execute_all();
    if (!busy()) {
      commands_.wait();
    } else if (const auto due = work({})) {
      commands_.wait_until(*due);
    }
  }
}

void EngineWork::run_slice(Clock::duration elapsed, Clock::time_point due) {
  const bool opened = opens();
  execute_all();
  // A new opening has already had its slice.
  if (!busy() || (opens() && !opened)) return;
  pace_.set_frame(elapsed);
  work(due);
}

// Works for a frame, until it is due or until the end of the slice. Returns the real time at which
// the next frame follows. Absent: at once.
std::optional<EngineWork::Clock::time_point> EngineWork::work(
    std::optional<Clock::time_point> slice_end) {
  const auto now = Clock::now();
  if (opens()) {
    open_on();
  } else if (has_errand()) {
    go_on();
  } else if (auto* backwards = std::get_if<PlayingBackwards>(&motion_); gases_ && backwards) {
    begin_rewind(*backwards);
    const Pace::Goal goal = pace_.next(now, -backwards->wanted);
    const Clock::time_point due = slice_end.value_or(goal.due);
    if (rewind(*backwards, -goal.time, due)) return due;
  } else if (gases_ && in<Playing>()) {
    const Pace::Goal goal = pace_.next(now, time());
    const Clock::time_point due = slice_end.value_or(goal.due);
    if (play(goal.time, due)) return due;
  } else if (moves()) {
    step(slice_end ? std::chrono::duration<double>(*slice_end - now).count() : frame_seconds_);
  } else {
    publish();  // looks ahead
  }
  return {};
}

void EngineWork::report(const std::string& message) {
  message_ = message;
  ++messages_;
}

void EngineWork::halt() {
  motion_ = Halted{};
  partners_.reset();
  pace_.restart();
}

// Continues the opening for a slice of time.
void EngineWork::work_on_opening() {
  constexpr std::chrono::milliseconds kSlice{20};
  const auto due = Clock::now() + kSlice;
  const auto pauses = [&] { return Clock::now() >= due || commands_.pending(); };
  if (!attempt([&] { std::get<OpeningGases>(errand_).advance(pauses); })) errand_ = {};
}

// A slice of the opening, after which the other commands follow. The first frame of the run has a
// slice of its own, because its picture takes long.
void EngineWork::open_on() {
  if (std::get<OpeningGases>(errand_).complete()) {
    attempt([this] { finish_opening(); });
  } else {
    work_on_opening();
  }
  if (!opens()) {
    ++handled_;
    execute_all();
  }
  publish();
}

void EngineWork::finish_opening() {
  OpeningGases opening = std::get<OpeningGases>(std::exchange(errand_, {}));
  const command::Open& asked = opening.asked();
  halt();
  std::vector<std::unique_ptr<WatchedRun>> runs = opening.take();
  std::vector<std::uint64_t> ids;
  for (std::size_t k = 0; k < runs.size(); ++k) ids.push_back(++ids_);
  gases_ = std::make_unique<GasesInStep>(std::move(runs), std::move(ids),
                                         std::min(asked.gas, asked.others.size()));
  gases_->show_profile(profiled_.what, profiled_.axis);
  gases_->listen(played_.listens());
  played_.change_laws();
  pace_.set_speed(asked.scene.view.speed);
  pace_.set_factors(asked.scene.view.pace);
  if (asked.plays) motion_ = Playing{};
  if (asked.at > 0.0) errand_ = Travelling{.to = asked.at, .forward = true};
  ++runs_;
  loop_.reset();
  stop_.clear();
  rate_.restart();
}

// Begins the way to a time of the run so far.
void EngineWork::go_to(double time) {
  gases_->go_back(time);
  errand_ = Travelling{.to = time};
}

// Continues the search for the last collision. Returns whether it has ended; then the run goes
// there.
bool EngineWork::search(const StopRequest& pause) {
  if (!gases_->search_back(pause)) return false;
  const std::optional<PreviousCollision> collision = gases_->previous_collision();
  go_to(collision ? collision->time : 0.0);
  if (collision) std::get<Travelling>(errand_).partners = collision->partners;
  return true;
}

// Continues the way to another time. Returns whether the run is there.
bool EngineWork::travel(const StopRequest& pause) {
  const Travelling& way = std::get<Travelling>(errand_);
  if (!gases_->prepare(pause)) return false;
  while (time() < way.to && !gases_->run_until(way.to, kNoLimit, kNoLimit, pause)) {
    if (pause.made()) return false;
  }
  if (way.partners) partners_ = way.partners;
  return true;
}

// A slice of the way to another time. Frames follow at its end.
void EngineWork::go_on() {
  constexpr std::chrono::milliseconds kSlice{20};
  const auto due = Clock::now() + kSlice;
  const auto pauses = [&] { return Clock::now() >= due || commands_.pending(); };
  rate_.restart();
  stop_.clear();
  bool arrived = false;
  const bool possible = attempt([&] {
    if (std::holds_alternative<Searching>(errand_) && !search(pauses)) return;
    arrived = travel(pauses);
  });
  if (possible && !arrived) return show_way();
  errand_ = {};
  pace_.restart();
  publish();
  execute_all();
}

// A frame of the way to Open::at, now and then.
void EngineWork::show_way() {
  constexpr std::chrono::milliseconds kBetween{250};
  const auto* way = std::get_if<Travelling>(&errand_);
  if (!way || !way->forward || Clock::now() - way_shown_ < kBetween) return;
  way_shown_ = Clock::now();
  publish();
}

void EngineWork::begin_rewind(PlayingBackwards& motion) {
  if (motion.rewinder) return;
  motion.shown = motion.wanted = time();
  motion.rewinder.emplace(*gases_, pace_.speed() * frame_seconds_);
}

// Brings the run to the time of the shown frame.
void EngineWork::end_rewind() {
  auto* backwards = std::get_if<PlayingBackwards>(&motion_);
  if (!backwards || !backwards->rewinder) return;
  backwards->rewinder.reset();
  go_to(backwards->shown);
}

// Shows the frame at a time, and then makes earlier ones, until the real time `due` or the next
// command. Returns whether it has time left. If the frame is late, the delay is dropped.
bool EngineWork::rewind(PlayingBackwards& motion, double time, Clock::time_point due) {
  Rewinder& rewinder = *motion.rewinder;
  const auto late = [&] { return Clock::now() >= due || commands_.pending(); };
  const auto in_time = [&] { return !late(); };
  std::optional<Frame> frame;
  const bool works = attempt([&] {
    const bool asked = rewinder.due(time);
    while (asked && !(frame = rewinder.take(time)) && in_time()) rewinder.work(late);
    motion.wanted = asked && !frame ? motion.shown : time;
    if (frame) motion.shown = frame->snapshot.time;
    if (frame && motion.shown > 0.0) publish_rewound(std::move(*frame));
    while (rewinder.busy() && in_time()) rewinder.work(late);
  });
  if (works && motion.shown > 0.0) return in_time();
  attempt([this] { end_rewind(); });
  halt();
  if (!has_errand()) publish();
  return false;
}

// Runs up to `time`, but at most until the real time `due` or the next command. Returns whether
// it reached `time`.
bool EngineWork::advance(double time, std::uint64_t collisions, Clock::time_point due) {
  bool arrived = false;
  stop_.clear();
  if (!attempt([&] { arrived = run_slices(time, collisions, due); })) {
    halt();
    stop_ = message_;
  }
  return arrived;
}

// The same for a gas that plays, whose clicks are kept for listeners.
bool EngineWork::advance_heard(double time, Clock::time_point due) {
  if (!played_.listens()) return advance(time, kNoLimit, due);
  constexpr double kLeastHeld = 0.01;
  gases_->take_clicks();  // of the way to the present time, which nobody hears
  const double from = this->time();
  const bool arrived = advance(time, kNoLimit, due);
  played_.add({.from = from,
               .to = this->time(),
               .speed = pace_.speed_at(from) * std::max(kLeastHeld, pace_.held()),
               .clicks = gases_->take_clicks()});
  return arrived;
}

bool EngineWork::run_slices(double time, std::uint64_t collisions, Clock::time_point due) {
  constexpr std::chrono::milliseconds kSlice{2};
  constexpr std::uint64_t kLongestSlice = 1u << 20;
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
bool EngineWork::play(double goal, Clock::time_point due) {
  const double until = std::get<Playing>(motion_).until;
  const bool repeats = loop_ && time() < (*loop_)[1];
  const double end = repeats ? std::min(until, (*loop_)[1]) : until;
  const bool arrived = advance_heard(std::min(goal, end), due);
  if (arrived && time() >= until) {
    halt();
  } else if (arrived && repeats && goal >= end) {
    pace_.restart();
    if (!attempt([this] { go_to((*loop_)[0]); })) halt();
  }
  if (!has_errand()) publish();
  return arrived && in<Playing>();
}

// Runs at full speed for some seconds of real time, before a frame.
void EngineWork::step(double seconds) {
  const auto due = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(seconds));
  if (const auto* stepping = std::get_if<Stepping>(&motion_)) {
    if (advance(stepping->to, kNoLimit, due)) halt();
  } else {
    const double ahead = time() + pace_.speed() * frame_seconds_;
    const std::uint64_t last = std::get<SteppingToCollision>(motion_).number;
    while (in<SteppingToCollision>() && time() < ahead && Clock::now() < due &&
           !commands_.pending()) {
      advance(ahead, gases_->counts().collisions() + 1, due);
      if (in<SteppingToCollision>() && gases_->counts().pair_collisions >= last)
        halt_at_collision();
    }
  }
  publish();
}

void EngineWork::halt_at_collision() {
  halt();
  partners_ = gases_->partners();
  attempt([this] { gases_->settle(); });
}

void EngineWork::publish() {
  if (gases_ && !attempt([&] { gases_->fill(frames_.back(), !moves()); })) halt();
  send_frame();
}

void EngineWork::publish_rewound(Frame frame) {
  frames_.back() = std::move(frame);
  send_frame();
}

// Sends the next frame, with the state of the engine.
void EngineWork::send_frame() {
  Frame& frame = frames_.back();
  frame.opening.reset();
  if (const auto* opening = std::get_if<OpeningGases>(&errand_)) {
    frame.opening = opening->progress();
  }
  frame.bound_for.reset();
  const auto* way = std::get_if<Travelling>(&errand_);
  if (way && way->forward) frame.bound_for = way->to;
  frame.run = runs_;
  frame.handled = handled_;
  frame.backwards = in<PlayingBackwards>();
  frame.plays = in<Playing>() || frame.backwards;
  frame.loop = loop_;
  frame.speed = pace_.speed();
  for (Frame& other : frame.others) {
    other.run = runs_;
    other.speed = pace_.speed();
  }
  frame.held = pace_.held();
  if (gases_ && in<Playing>()) {
    rate_.count(gases_->counts().collisions());
  } else {
    rate_.halt();
  }
  frame.events_per_second = rate_.per_second();
  frame.partners = partners_;
  frame.played = played_.last();
  frame.stop = stop_;
  frame.message = message_;
  frame.messages = messages_;
  frames_.publish();
  on_publish_();
}

}  // namespace clatter
