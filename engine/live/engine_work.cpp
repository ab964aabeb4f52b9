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

void EngineWork::run_slice(Clock::duration elapsed, Clock::time_point due) {
  const bool opened = opening_.has_value();
  execute_all();
  if (opening_) {
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

void EngineWork::report(const std::string& message) {
  message_ = message;
  ++messages_;
}

void EngineWork::halt() {
  plays_ = backwards_ = false;
  step_to_.reset();
  to_collision_.reset();
  partners_.reset();
  pace_.restart();
}

// Continues the opening for a slice of time.
void EngineWork::work_on_opening() {
  constexpr std::chrono::milliseconds kSlice{20};
  const auto due = Clock::now() + kSlice;
  const auto pauses = [&] { return Clock::now() >= due || commands_.pending(); };
  if (!attempt([&] { opening_->advance(pauses); })) opening_.reset();
}

// A slice of the opening, after which the other commands follow. The first frame of the run has a
// slice of its own, because its picture takes long.
void EngineWork::open_on() {
  if (opening_->complete()) {
    attempt([this] { finish_opening(); });
  } else {
    work_on_opening();
  }
  if (!opening_) {
    ++handled_;
    execute_all();
  }
  publish();
}

void EngineWork::finish_opening() {
  OpeningGases opening = *std::exchange(opening_, std::nullopt);
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
  plays_ = asked.plays;
  until_ = std::numeric_limits<double>::infinity();
  ++runs_;
  loop_.reset();
  stop_.clear();
  rate_.restart();
}

// Begins the way to a time of the run so far.
void EngineWork::go_to(double time) {
  gases_->go_back(time);
  going_to_ = time;
}

// Ends the way to another time, wherever the run is.
void EngineWork::stay() {
  searches_ = false;
  going_to_.reset();
  partners_there_.reset();
}

// A slice of the way to another time. Frames follow at its end.
void EngineWork::go_on() {
  constexpr std::chrono::milliseconds kSlice{20};
  const auto due = Clock::now() + kSlice;
  const auto pauses = [&] { return Clock::now() >= due || commands_.pending(); };
  rate_.restart();
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
  execute_all();
}

void EngineWork::begin_rewind() {
  if (rewinder_) return;
  shown_ = wanted_ = time();
  rewinder_.emplace(*gases_, pace_.speed() * frame_seconds_);
}

// Brings the run to the time of the shown frame.
void EngineWork::end_rewind() {
  if (!rewinder_) return;
  rewinder_.reset();
  go_to(shown_);
}

// Shows the frame at a time, and then makes earlier ones, until the real time `due` or the next
// command. Returns whether it has time left. If the frame is late, the delay is dropped.
bool EngineWork::rewind(double time, Clock::time_point due) {
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
void EngineWork::step(double seconds) {
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
  if (opening_) frame.opening = opening_->progress();
  frame.run = runs_;
  frame.handled = handled_;
  frame.plays = plays_;
  frame.backwards = backwards_;
  frame.loop = loop_;
  frame.speed = pace_.speed();
  for (Frame& other : frame.others) {
    other.run = runs_;
    other.speed = pace_.speed();
  }
  frame.held = pace_.held();
  if (plays_ && !backwards_ && gases_) {
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
