#include "engine/live/gases_in_step.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/error.h"

namespace clatter {

GasesInStep::GasesInStep(std::vector<std::unique_ptr<WatchedRun>> runs,
                         std::vector<std::uint64_t> ids, std::size_t selected)
    : selected_(selected) {
  for (std::size_t k = 0; k < runs.size(); ++k) gases_.push_back({std::move(runs[k]), ids[k]});
}

void GasesInStep::add_copy(std::uint64_t id) {
  if (gases_.size() == kMostGases) {
    throw UserError({}, "no more than " + std::to_string(kMostGases) + " gases run in step",
                    "remove one first");
  }
  gases_.push_back({selected().copy(), id});
}

void GasesInStep::remove(std::size_t gas) {
  if (gas >= gases_.size() || gases_.size() == 1) return;
  gases_.erase(gases_.begin() + static_cast<std::ptrdiff_t>(gas));
  if (selected_ >= gas && selected_ > 0) --selected_;
  selected().listen(listens_);
}

void GasesInStep::select(std::size_t gas) {
  if (gas >= gases_.size() || gas == selected_) return;
  selected().pick(std::nullopt);
  selected().listen(false);
  selected_ = gas;
  selected().listen(listens_);
}

double GasesInStep::time() const {
  double least = selected().time();
  for (const Gas& gas : gases_) least = std::min(least, gas.run->time());
  return least;
}

bool GasesInStep::prepare(const StopRequest& pause) {
  return std::ranges::all_of(gases_, [&](const Gas& gas) { return gas.run->prepare(pause); });
}

// Does something that may move the selected run, also if it fails. Returns the result of follow().
template <class Act>
bool GasesInStep::lead(const Act& act, const StopRequest& pause) {
  try {
    act();
  } catch (...) {
    follow();
    throw;
  }
  return follow(pause);
}

bool GasesInStep::run_until(double time, std::uint64_t collisions, std::uint64_t steps,
                            const StopRequest& pause) {
  bool arrived = false;
  const bool followed =
      lead([&] { arrived = selected().run_until(time, collisions, steps, pause); }, pause);
  return followed && arrived;
}

// Runs the others to the time of the selected run. Returns false at a request to pause.
bool GasesInStep::follow(const StopRequest& pause) {
  const double time = selected().time();
  for (std::size_t k = 0; k < gases_.size(); ++k) {
    if (k == selected_) continue;
    WatchedRun& run = *gases_[k].run;
    try {
      while (run.time() < time && !run.run_until(time, kNoLimit, kNoLimit, pause)) {
        if (pause.made()) return false;
      }
    } catch (const PhysicalStop& stop) {
      meet_at(run.time());
      throw PhysicalStop(std::string("gas ") + static_cast<char>('A' + k) + ": " + stop.what(),
                         stop.remedy());
    }
  }
  return true;
}

// Brings all runs to a time that all of them can reach.
void GasesInStep::meet_at(double time) {
  for (const Gas& gas : gases_) {
    if (gas.run->time() > time) gas.run->go_back(time);
    while (gas.run->time() < time) gas.run->run_until(time, kNoLimit, kNoLimit);
  }
}

void GasesInStep::settle() {
  lead([this] { selected().settle(); });
}

void GasesInStep::change(const std::vector<Override>& laws, double delay) {
  lead([&] { selected().change(laws, delay); });
}

void GasesInStep::nudge(const Nudge& nudge, double delay) {
  lead([&] { selected().nudge(nudge, delay); });
}

void GasesInStep::puff(const Puff& puff, double delay) {
  lead([&] { selected().puff(puff, delay); });
}

void GasesInStep::reverse(double delay) {
  lead([&] { selected().reverse(delay); });
}

void GasesInStep::move_piston(double position, double duration, double delay) {
  lead([&] { selected().move_piston(position, duration, delay); });
}

// The selected run is on its way to a time. The others begin their ways.
double GasesInStep::others_go_back(double time) {
  for (std::size_t k = 0; k < gases_.size(); ++k) {
    if (k != selected_) gases_[k].run->go_back(time);
  }
  return time;
}

double GasesInStep::replace_changes(std::vector<Change> changes, double from) {
  return others_go_back(selected().replace_changes(std::move(changes), from));
}

double GasesInStep::exchange_futures() {
  return others_go_back(selected().exchange_futures());
}

double GasesInStep::move_change(std::size_t number, double time) {
  return others_go_back(selected().move_change(number, time));
}

void GasesInStep::go_back(double time) {
  selected().go_back(time);
  others_go_back(time);
}

void GasesInStep::show(const View& view) {
  const std::vector<Species>& species = selected().laws().species;
  for (const Gas& gas : gases_) {
    if (gas.run->dimension() != dimension()) continue;
    gas.run->show(gas.run->laws().adapted(view, species));
  }
}

void GasesInStep::show_profile(Profiled what, Axis axis) {
  for (const Gas& gas : gases_) gas.run->show_profile(what, axis);
}

void GasesInStep::listen(bool on) {
  listens_ = on;
  selected().listen(on);
}

void GasesInStep::fill(Frame& frame, bool halted) {
  frame.others.resize(gases_.size() - 1);
  auto next = frame.others.begin();
  for (std::size_t k = 0; k < gases_.size(); ++k) {
    Frame& own = k == selected_ ? frame : *next++;
    gases_[k].run->fill(own, halted);
    own.gas = k;
    own.id = gases_[k].id;
  }
}

std::vector<const Frame*> frames_of(const Frame& frame) {
  std::vector<const Frame*> frames;
  for (const Frame& other : frame.others) frames.push_back(&other);
  const std::size_t place = std::min(frame.gas, frames.size());
  frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(place), &frame);
  return frames;
}

}  // namespace clatter
