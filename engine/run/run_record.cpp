#include "engine/run/run_record.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace clatter {

template <int D>
std::size_t SavedState<D>::bytes() const {
  const auto size = [](const auto& list) { return list.size() * sizeof(list[0]); };
  return sizeof *this + size(run.flights) + size(run.spins) + size(run.last_collisions) +
         size(run.remainders) + size(rotations);
}

template <int D>
bool RunRecord<D>::due(std::uint64_t work) const {
  return work >= states_.back()->work() + spacing_;
}

template <int D>
void RunRecord<D>::add(SavedState<D> state) {
  // A return to a state predicts the plans of all particles: the work of some events of each.
  constexpr std::uint64_t kFewEvents = 20'000, kEventsPerParticle = 5;
  if (spacing_ == 0) spacing_ = kFewEvents + kEventsPerParticle * state.run.flights.size();
  if (!states_.empty() && states_.back()->time == state.time) {
    state.stopped |= states_.back()->stopped;
    bytes_ -= states_.back()->bytes();
    states_.pop_back();
  }
  push(std::make_shared<const SavedState<D>>(std::move(state)));
}

template <int D>
void RunRecord<D>::push(std::shared_ptr<const SavedState<D>> state) {
  bytes_ += state->bytes();
  states_.push_back(std::move(state));
  while (bytes_ > budget_ && spacing_ < kNoLimit / 2) thin_out();
}

template <int D>
void RunRecord<D>::thin_out() {
  spacing_ *= 2;
  States kept;
  for (auto& state : states_) {
    const bool remains = kept.empty() || &state == &states_.back() || state->stopped;
    if (!remains && state->work() < kept.back()->work() + spacing_) {
      bytes_ -= state->bytes();
    } else {
      kept.push_back(std::move(state));
    }
  }
  states_ = std::move(kept);
}

template <int D>
static double time_of(const std::shared_ptr<const SavedState<D>>& state) {
  return state->time;
}

template <int D>
typename RunRecord<D>::States RunRecord<D>::cut(double time) {
  const auto first = std::ranges::lower_bound(states_, time, {}, time_of<D>);
  States removed(first, states_.end());
  states_.erase(first, states_.end());
  for (const auto& state : removed) bytes_ -= state->bytes();
  return removed;
}

template <int D>
void RunRecord<D>::append(const States& states) {
  for (const auto& state : states) push(state);
}

template <int D>
const SavedState<D>& RunRecord<D>::before(double time) const {
  const auto after = std::ranges::upper_bound(states_, time, {}, time_of<D>);
  return after == states_.begin() ? *states_.front() : **(after - 1);
}

template <int D>
const SavedState<D>* RunRecord<D>::after(double time, std::uint64_t collisions) const {
  const auto state = std::ranges::find_if(states_, [&](const auto& saved) {
    return saved->time > time ||
           (saved->time == time && saved->run.counts.collisions() > collisions);
  });
  return state == states_.end() ? nullptr : state->get();
}

template <int D>
std::vector<double> RunRecord<D>::stops() const {
  std::vector<double> times;
  for (const auto& state : states_) {
    if (state->stopped) times.push_back(state->time);
  }
  return times;
}

template struct SavedState<2>;
template struct SavedState<3>;
template class RunRecord<2>;
template class RunRecord<3>;

}  // namespace clatter
