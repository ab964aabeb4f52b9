#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/dynamics/large_array.h"
#include "engine/dynamics/tile_record.h"

namespace clatter {

/// The foreseen events of a window, in the order in which the run processes them.
template <int D>
class ForeseenEvents {
 public:
  /// Removes all events.
  void clear();
  /// Replaces all events by those of several lists, each almost in order. They have times from
  /// `start` to `end`. Up to `threads` threads sort them.
  void join(const std::vector<std::span<const ForeseenEvent<D>>>& lists, double start, double end,
            std::size_t threads);

  /// Whether there are no events.
  bool empty() const { return at_ == events_.size() && waiting_.empty(); }
  /// The next event, or null. `is_next(event)` returns whether an event begins with the current
  /// flights of its particles.
  template <typename IsNext>
  const ForeseenEvent<D>* next(const IsNext& is_next);
  /// Removes the event that next() returned.
  void pop();
  /// Calls visit(event) for the event `ahead` places after the next one, so that the caller can
  /// prefetch its data.
  template <typename Visit>
  void look_past(std::size_t ahead, const Visit& visit) const {
    if (at_ + ahead < events_.size()) visit(events_[at_ + ahead]);
  }

 private:
  LargeArray<ForeseenEvent<D>> events_;
  std::size_t at_ = 0;  // of the next event
  // Events that come after a simultaneous one by rounding, although their times are earlier.
  std::vector<ForeseenEvent<D>> waiting_;
  bool from_waiting_ = false;
};

template <int D>
template <typename IsNext>
const ForeseenEvent<D>* ForeseenEvents<D>::next(const IsNext& is_next) {
  from_waiting_ = false;
  if (!waiting_.empty()) [[unlikely]] {
    const auto sooner = [](const auto& a, const auto& b) { return before(b.event, a.event); };
    std::ranges::stable_sort(waiting_, sooner);
    for (std::size_t k = waiting_.size(); k-- > 0;) {
      if (!is_next(waiting_[k])) continue;
      std::rotate(waiting_.begin() + static_cast<std::ptrdiff_t>(k),
                  waiting_.begin() + static_cast<std::ptrdiff_t>(k) + 1, waiting_.end());
      from_waiting_ = true;
      return &waiting_.back();
    }
  }
  for (; at_ < events_.size(); ++at_) {
    if (is_next(events_[at_])) return &events_[at_];
    waiting_.push_back(events_[at_]);
  }
  return nullptr;
}

extern template class ForeseenEvents<2>;
extern template class ForeseenEvents<3>;

}  // namespace clatter
