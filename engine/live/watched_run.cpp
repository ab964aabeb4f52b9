#include "engine/live/watched_run.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "engine/error.h"
#include "engine/initial/memory.h"
#include "engine/initial/start_state.h"
#include "engine/live/run_watch.h"
#include "engine/run/run_record.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/act_checks.h"

namespace clatter {

namespace {

UserError no_change() {
  return {{}, "there is no such change after time 0", "choose another change"};
}

template <int D>
class RunOf : public WatchedRun {
 public:
  RunOf(const Scene& scene, std::uint64_t seed, State<D> start, std::size_t record_bytes);
  // A copy of a run, whose present state is `now`.
  RunOf(const RunOf& of, const SavedState<D>& now);
  RunOf(const RunOf&) = delete;
  RunOf& operator=(const RunOf&) = delete;

  double time() const override { return run_.simulation().time(); }
  const EventCounts& counts() const override { return run_.simulation().counts(); }
  int dimension() const override { return D; }
  const Scene& laws() const override { return run_.laws(); }
  AnyState state() const override {
    State<D> state = run_.simulation().state();
    add_flow(state, run_.simulation().domain(), -1.0);
    return state;
  }
  std::unique_ptr<WatchedRun> copy() override;
  bool prepare(const StopRequest& pause) override { return run_.prepare(pause); }
  bool run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                 const StopRequest& pause) override;
  void settle() override;
  void change(const std::vector<Override>& laws, double delay) override {
    branch([&] { run_.change(laws, delay); });
  }
  void nudge(const Nudge& nudge, double delay) override;
  void puff(const Puff& puff, double delay) override;
  void reverse(double delay) override;
  void move_piston(double position, double duration, double delay) override;
  double replace_changes(std::vector<Change> changes, double from) override;
  double head() const override { return std::max(head_, time()); }
  double move_change(std::size_t number, double time) override;
  double exchange_futures() override;
  bool search_back(const StopRequest& pause) override;
  std::optional<PreviousCollision> previous_collision() const override {
    return watch_.last_collision().found();
  }
  void go_back(double time) override;
  void show(const View& view) override { run_.show(view); }
  void show_profile(Profiled what, Axis axis) override { watch_.show_profile(what, axis); }
  void listen(bool on) override { watch_.listen(on); }
  std::vector<Click> take_clicks() override { return watch_.take_clicks(); }
  void pick(std::optional<std::uint32_t> particle) override { watch_.pick(particle); }
  void fill(Frame& frame, bool halted) override;
  bool looks_ahead() const override { return watch_.looks_ahead(); }
  const std::optional<std::array<std::uint32_t, 2>>& partners() const override {
    return watch_.last_collision().partners();
  }

 private:
  // The part of a run after a change in the past.
  struct Future {
    double from = 0.0;  // time of the change
    double head = 0.0;
    std::vector<Change> changes;  // all changes of the run
    typename RunRecord<D>::States states;
    std::size_t bytes() const;
  };

  // A search for the last collision before a time.
  struct Search {
    double end;                       // no collision is after this time
    std::optional<double> from = {};  // time of the recorded state that it started from
  };

  void note_changes();
  SavedState<D> saved_state();
  void record(bool stopped = false);
  void record_change();
  bool record_is_due() const;
  void save_head();
  void return_to(const SavedState<D>& saved, const std::vector<Change>& changes);
  double leave_start(double delay);
  Future end_future(double from);
  Future fork();
  void branch(const std::function<void()>& change);

  ScheduledRun<D> run_;
  RunWatch<D> watch_;
  std::shared_ptr<const Scene> started_;
  std::shared_ptr<const Scene> scene_;  // of the last frame
  RunRecord<D> record_;
  std::shared_ptr<const Scene> recorded_laws_;  // of the last recorded state; nullptr: others now
  std::uint64_t changes_ = 0;                   // that these scenes have
  bool settled_ = false;                        // all events up to the present time are processed
  double head_ = 0.0;                           // latest time reached before the present one
  std::size_t record_bytes_;
  std::optional<Search> search_;
  std::optional<Future> other_;  // that the last change in the past replaced
  std::uint64_t futures_ = 0;    // number of changes of the future
  double forked_at_ = 0.0;       // time of the last one
};

template <int D>
RunOf<D>::RunOf(const Scene& scene, std::uint64_t seed, State<D> start, std::size_t record_bytes)
    : run_(scene, seed, std::move(start)),
      watch_(run_),
      started_(std::make_shared<const Scene>(scene)),
      record_(record_bytes),
      record_bytes_(record_bytes) {
  run_.show(scene.view);
  SavedState<D> first = saved_state();
  first.changed_until = -std::numeric_limits<double>::infinity();
  record_.add(std::move(first));
}

template <int D>
RunOf<D>::RunOf(const RunOf& of, const SavedState<D>& now)
    : run_(of.run_.scene(), of.run_.seed(), now.run),
      watch_(run_),
      started_(of.started_),
      record_(of.record_),
      head_(of.head_),
      record_bytes_(of.record_bytes_),
      futures_(of.futures_),
      forked_at_(of.forked_at_) {
  run_.show(of.run_.laws().view);
  watch_.show_profile_of(of.watch_);
  return_to(now, of.run_.scene().changes);
}

template <int D>
std::unique_ptr<WatchedRun> RunOf<D>::copy() {
  settle();
  return std::make_unique<RunOf>(*this, saved_state());
}

// Forgets the scenes of before the last change of the run.
template <int D>
void RunOf<D>::note_changes() {
  if (std::exchange(changes_, counts().changes()) == counts().changes()) return;
  scene_.reset();
  recorded_laws_.reset();
}

// The present state. The particles of the start are those of the run's start.
template <int D>
SavedState<D> RunOf<D>::saved_state() {
  watch_.close_window();
  note_changes();
  if (!recorded_laws_) {
    Scene laws = run_.laws();
    laws.particles.start = {};
    recorded_laws_ = std::make_shared<const Scene>(std::move(laws));
  }
  return {.time = time(),
          .run = run_.simulation().save(),
          .laws = recorded_laws_,
          .changed_until = time(),
          .rotations = run_.rotations(),
          .tally = watch_.tally()};
}

// Records the present state as the latest one. The other future gives way if memory is short.
template <int D>
void RunOf<D>::record(bool stopped) {
  head_ = time();
  SavedState<D> state = saved_state();
  state.stopped = stopped;
  if (other_ && record_.bytes() + state.bytes() + other_->bytes() > record_bytes_) other_.reset();
  record_.add(std::move(state));
}

// After a change at the present time. A replay from an earlier state makes the change again, but a
// recorded state of this time has the former laws.
template <int D>
void RunOf<D>::record_change() {
  head_ = time();
  if (record_.before(time()).time == time() || record_is_due()) record();
}

// Records the present state, if it is the latest and not yet recorded.
template <int D>
void RunOf<D>::save_head() {
  if (time() < head_ || record_.before(time()).time == time()) return;
  settle();
  record();
}

template <int D>
bool RunOf<D>::record_is_due() const {
  return record_.due(work_of(counts(), run_.simulation().particles().size()));
}

template <int D>
void RunOf<D>::settle() {
  if (!settled_) run_.settle();
  settled_ = true;
}

// A run that stopped by itself may have continued under other laws. Its replay then continues from
// the next recorded state.
template <int D>
bool RunOf<D>::run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                         const StopRequest& pause) {
  settled_ = false;
  try {
    const bool arrived = settled_ = run_.run_until(time, collisions, steps, pause);
    if (record_is_due()) save_head();
    return arrived;
  } catch (const PhysicalStop&) {
    const SavedState<D>* next = record_.after(this->time(), counts().collisions());
    if (next && next->time <= time) {
      return_to(*next, run_.scene().changes);
      return false;
    }
    if (this->time() >= head_) record(true);
    throw;
  }
}

// The start state is that of the run, which recorded laws lack.
template <int D>
void RunOf<D>::return_to(const SavedState<D>& saved, const std::vector<Change>& changes) {
  head_ = head();
  Scene scene = *saved.laws;
  scene.particles.start = started_->particles.start;
  scene.changes = changes;
  run_.return_to(scene, saved.changed_until, saved.run, saved.rotations);
  watch_.return_to(saved.tally);
  scene_.reset();
  recorded_laws_.reset();
  settled_ = !saved.stopped;
}

// An earlier state gives averages and trails the time to form, if it needs little more work.
template <int D>
void RunOf<D>::go_back(double time) {
  search_.reset();
  save_head();
  const View& view = run_.laws().view;
  const double span =
      std::max(view.shows_averages() ? view.window : 0.0, view.trails.value_or(0.0));
  const SavedState<D>& nearest = record_.before(time);
  if (nearest.time <= this->time() && this->time() <= time) return;
  const SavedState<D>& early = record_.before(time - span);
  const bool near = nearest.work() - early.work() <= record_.spacing();
  return_to(near ? early : nearest, run_.scene().changes);
}

template <int D>
std::size_t RunOf<D>::Future::bytes() const {
  std::size_t bytes = 0;
  for (const auto& state : states) bytes += state->bytes();
  return bytes;
}

// Removes the states of the run from a time on, and returns this part of the run.
template <int D>
typename RunOf<D>::Future RunOf<D>::end_future(double from) {
  ++futures_;
  forked_at_ = from;
  return {from, std::exchange(head_, from), run_.scene().changes, record_.cut(from)};
}

// Makes a change at the present time. An impossible change in the past restores the future.
template <int D>
void RunOf<D>::branch(const std::function<void()>& change) {
  const bool forks = time() < head_;
  std::optional<Future> before;
  if (forks) before = std::exchange(other_, fork());
  try {
    change();
  } catch (...) {
    if (forks) {
      run_.run_until(exchange_futures());
      other_ = std::move(before);
    }
    throw;
  }
  settled_ = true;
  scene_.reset();
  record_change();
}

// The record keeps no state before a change at time 0, and such an act could not be
// removed. Runs for a part of the delay at time 0, and returns the rest.
template <int D>
double RunOf<D>::leave_start(double delay) {
  if (time() > 0.0) return delay;
  run_until(0.5 * delay, kNoLimit, kNoLimit, {});
  return 0.5 * delay;
}

template <int D>
void RunOf<D>::nudge(const Nudge& nudge, double delay) {
  delay = leave_start(delay);
  branch([&] { run_.nudge(nudge, delay); });
}

template <int D>
void RunOf<D>::puff(const Puff& puff, double delay) {
  delay = leave_start(delay);
  branch([&] { run_.puff(puff, delay); });
}

template <int D>
void RunOf<D>::reverse(double delay) {
  delay = leave_start(delay);
  branch([&] { run_.reverse(delay); });
}

template <int D>
void RunOf<D>::move_piston(double position, double duration, double delay) {
  delay = leave_start(delay);
  branch([&] { run_.move_piston(position, duration, delay); });
}

// Begins another future without the user's later changes, and returns the old one.
template <int D>
typename RunOf<D>::Future RunOf<D>::fork() {
  settle();
  Future old = end_future(time());
  std::vector<Change> changes = old.changes;
  const auto own = changes.begin() + static_cast<std::ptrdiff_t>(started_->changes.size());
  const auto later = [this](const Change& change) { return change.time > head_; };
  changes.erase(std::remove_if(own, changes.end(), later), changes.end());
  run_.set_changes(std::move(changes));
  record();
  return old;
}

template <int D>
double RunOf<D>::move_change(std::size_t number, double time) {
  std::vector<Change> changes = run_.scene().changes;
  if (number >= changes.size()) throw no_change();
  Change& moved = changes[number];
  const double from = std::min(moved.time, time);
  moved.until += time - moved.time;
  moved.time = time;
  Scene scene = run_.laws();
  scene.changes = changes;
  check_pistons(scene);
  check_nudges(scene);
  return replace_changes(std::move(changes), from);
}

template <int D>
double RunOf<D>::replace_changes(std::vector<Change> changes, double from) {
  from = std::min(from, head());
  if (!(from > 0.0)) throw no_change();
  save_head();
  other_ = end_future(from);
  return_to(record_.before(from), changes);
  head_ = from;
  return from;
}

template <int D>
double RunOf<D>::exchange_futures() {
  if (!other_) throw UserError({}, "there is no other future", "change a law in the past first");
  save_head();
  const double time = std::min(this->time(), other_->from);
  Future now = end_future(other_->from);
  record_.append(other_->states);
  return_to(record_.before(time), other_->changes);
  head_ = other_->head;
  other_ = std::move(now);
  return time;
}

// Searches from one recorded state to the next, backwards.
template <int D>
bool RunOf<D>::search_back(const StopRequest& pause) {
  constexpr double kRoundings = 8.0 * std::numeric_limits<double>::epsilon();
  if (!search_) {
    save_head();
    watch_.last_collision().search_before(time() * (1.0 - kRoundings));
    search_.emplace(Search{time()});
  }
  while (search_->from || (!watch_.last_collision().found() && search_->end > 0.0)) {
    if (!search_->from) {
      const SavedState<D>& start = record_.before(std::nextafter(search_->end, 0.0));
      search_->from = start.time;
      return_to(start, run_.scene().changes);
    }
    while (!run_until(search_->end, kNoLimit, kNoLimit, pause)) {
      if (pause.made()) return false;
    }
    search_ = Search{*search_->from};
  }
  search_.reset();
  return true;
}

template <int D>
void RunOf<D>::fill(Frame& frame, bool halted) {
  note_changes();
  if (!scene_) scene_ = std::make_shared<const Scene>(run_.present_scene());
  watch_.fill(frame, halted);
  frame.snapshot = run_.snapshot();
  frame.head = head();
  frame.stops = record_.stops();
  frame.futures = futures_;
  frame.forked_at = forked_at_;
  frame.other_future.reset();
  if (other_) frame.other_future = {other_->from, other_->head};
  frame.record_bytes = record_.bytes() + (other_ ? other_->bytes() : 0);
  frame.scene = scene_;
  frame.started = started_;
  frame.seed = run_.seed();
  frame.deepest_overlap = run_.simulation().checks().deepest_overlap;
  frame.state_hash.reset();
  if (halted) frame.state_hash = run_.simulation().state_hash();
}

}  // namespace

std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed, AnyState start,
                                        std::size_t record_bytes) {
  return std::visit(
      [&]<int D>(State<D>& state) -> std::unique_ptr<WatchedRun> {
        return std::make_unique<RunOf<D>>(scene, seed, std::move(state), record_bytes);
      },
      start);
}

std::unique_ptr<WatchedRun> watched_run(const Scene& scene, std::uint64_t seed,
                                        std::size_t record_bytes) {
  require_memory(scene);
  StartMaker maker(scene, seed);
  maker.advance();
  auto run = watched_run(scene, seed, maker.take(), record_bytes);
  run->prepare({});
  return run;
}

}  // namespace clatter
