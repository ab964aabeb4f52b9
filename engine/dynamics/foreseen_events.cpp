#include "engine/dynamics/foreseen_events.h"

#include <limits>
#include <utility>

#include "engine/dynamics/in_parallel.h"

namespace clatter {

template <int D>
void ForeseenEvents<D>::clear() {
  events_.clear();
  waiting_.clear();
  at_ = 0;
}

template <int D>
void ForeseenEvents<D>::pop() {
  if (from_waiting_) {
    waiting_.pop_back();
  } else {
    ++at_;
  }
}

// Each part of the time from `start` to `end` is sorted by one thread.
template <int D>
void ForeseenEvents<D>::join(const std::vector<std::span<const ForeseenEvent<D>>>& lists,
                             double start, double end, std::size_t threads) {
  clear();
  const auto sooner = [](const ForeseenEvent<D>& a, const ForeseenEvent<D>& b) {
    return before(a.event, b.event);
  };
  std::size_t total = 0;
  for (const auto& list : lists) total += list.size();
  constexpr std::size_t kInPart = 4096;
  const std::size_t parts = total / kInPart + 1;
  const auto bound = [&](std::size_t part) {
    return start + (end - start) * static_cast<double>(part) / static_cast<double>(parts);
  };
  // Where each part begins in each list.
  std::vector<std::size_t> cuts((parts + 1) * lists.size());
  in_parallel(threads, lists.size(), [&](std::size_t k, std::size_t) {
    std::size_t at = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const double from = part ? bound(part) : -std::numeric_limits<double>::infinity();
      while (at < lists[k].size() && lists[k][at].event.time < from) ++at;
      cuts[part * lists.size() + k] = at;
    }
    cuts[parts * lists.size() + k] = lists[k].size();
  });
  std::vector<std::size_t> begins(parts + 1);
  for (std::size_t part = 0; part < parts; ++part) {
    std::size_t size = 0;
    for (std::size_t k = 0; k < lists.size(); ++k) {
      size += cuts[(part + 1) * lists.size() + k] - cuts[part * lists.size() + k];
    }
    begins[part + 1] = begins[part] + size;
  }
  events_.resize(total);
  in_parallel(threads, parts, [&](std::size_t part, std::size_t) {
    ForeseenEvent<D>* at = events_.data() + begins[part];
    ForeseenEvent<D>* const first = at;
    for (std::size_t k = 0; k < lists.size(); ++k) {
      const ForeseenEvent<D>* const events = lists[k].data();
      at = std::copy(events + cuts[part * lists.size() + k],
                     events + cuts[(part + 1) * lists.size() + k], at);
    }
    std::sort(first, at, sooner);
  });
  // Rounding may put an event a little before its cause, into the wrong part.
  for (std::size_t k = 1; k < total; ++k) {
    for (std::size_t at = k; at > 0 && sooner(events_[at], events_[at - 1]); --at) {
      std::swap(events_[at], events_[at - 1]);
    }
  }
}

template class ForeseenEvents<2>;
template class ForeseenEvents<3>;

}  // namespace clatter
