#include "engine/dynamics/event_queue.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter {

void EventQueue::rebuild(std::vector<Event>& events) {
  spread(events, events.size() / 4);
}

// Three events a bucket, by the density of the first ones.
void EventQueue::spread(std::vector<Event>& events, std::size_t first) {
  current_.clear();
  moved_aside_ = 0;
  for (auto& bucket : buckets_) bucket.clear();
  in_buckets_ = in_rows_ = 0;
  rows_.assign(kRows, nullptr);
  chunks_.clear();
  spare_ = nullptr;
  later_.clear();
  bucket_ = 0;
  if (events.empty()) return;

  const auto last = events.begin() + static_cast<std::ptrdiff_t>(first);
  std::nth_element(events.begin(), last, events.end(), before);
  origin_ = std::min_element(events.begin(), last + 1, before)->time;
  const double width = 3.0 * (last->time - origin_) / static_cast<double>(first + 1);
  per_width_ = width > 0.0 && std::isfinite(1.0 / width) ? 1.0 / width : 1.0;

  // Rows so long that few events lie beyond the one at hand: which do cannot be foreseen.
  row_shift_ = 8;
  while (row_shift_ < 12 && (std::size_t{1} << row_shift_) < events.size()) ++row_shift_;
  in_row_ = (std::int64_t{1} << row_shift_) - 1;
  buckets_.resize(std::size_t{1} << row_shift_);
  for (const Event& event : events) {
    if (bucket_of(event.time) == bucket_) {
      current_.push_back(event);
    } else {
      push(event);
    }
  }
  sort_current();
}

std::int64_t EventQueue::bucket_of(double time) const {
  const double number = (time - origin_) * per_width_;
  return static_cast<std::int64_t>(std::clamp(number, 0.0, 0x1p62));
}

void EventQueue::push(const Event& event) {
  const std::int64_t number = bucket_of(event.time);
  if (number > last_of_row()) {
    add_to_row(event, number);
  } else if (number > bucket_) {
    buckets_[static_cast<std::size_t>(number & in_row_)].push_back(event);
    ++in_buckets_;
  } else {
    push_current(event);
  }
}

// Puts the last of the events where it belongs among the others, which are sorted, the earliest
// last. Returns how many it passes.
static std::size_t insert_last(Event* events, std::size_t size) {
  const Event event = events[size - 1];
  std::size_t at = size - 1;
  for (; at > 0 && before(events[at - 1], event); --at) events[at] = events[at - 1];
  events[at] = event;
  return size - 1 - at;
}

void EventQueue::sort_current() {
  constexpr std::size_t kFew = 16;
  if (current_.size() <= kFew) {
    for (std::size_t size = 2; size <= current_.size(); ++size) insert_last(current_.data(), size);
  } else {
    std::sort(current_.begin(), current_.end(),
              [](const Event& a, const Event& b) { return before(b, a); });
  }
}

// The bucket at hand holds some three events; where a few hot disks among many cold ones crowd it,
// the calendar is laid out anew before the crowding has cost more than that does.
void EventQueue::push_current(const Event& event) {
  current_.push_back(event);
  moved_aside_ += insert_last(current_.data(), current_.size());
  constexpr std::size_t kCrowd = 64;
  if (current_.size() > kCrowd &&
      moved_aside_ > 8 * (current_.size() + in_buckets_ + in_rows_ + later_.size())) {
    thin_out();
  }
}

// Lays the calendar out by the density of the bucket at hand.
void EventQueue::thin_out() {
  const std::size_t crowd = current_.size();
  std::vector<Event> events = std::exchange(current_, {});
  const auto take = [&](const auto& more) {
    events.insert(events.end(), more.begin(), more.end());
  };
  for (const auto& bucket : buckets_) take(bucket);
  for (const Chunk* chunk : rows_) {
    for (; chunk; chunk = chunk->next) {
      events.insert(events.end(), chunk->events.begin(), chunk->events.begin() + chunk->size);
    }
  }
  take(later_);
  spread(events, crowd - 1);
}

void EventQueue::add_to_row(const Event& event, std::int64_t bucket) {
  if ((bucket >> row_shift_) - (bucket_ >> row_shift_) >= kRows) {
    later_.push_back(event);
    return;
  }
  Chunk*& newest = row_of(bucket);
  if (!newest || newest->size == newest->events.size()) newest = add_chunk(newest);
  newest->events[newest->size++] = event;
  ++in_rows_;
}

EventQueue::Chunk* EventQueue::add_chunk(Chunk* next) {
  Chunk* added = spare_;
  if (added) {
    spare_ = added->next;
  } else {
    added = &chunks_.emplace_back();
  }
  added->next = next;
  added->size = 0;
  return added;
}

void EventQueue::next_bucket() {
  if (in_buckets_ + in_rows_ == 0) {
    // Nothing within reach: start afresh, at the width of what lies beyond.
    std::vector<Event> events = std::exchange(later_, {});
    rebuild(events);
    return;
  }
  if (in_buckets_ == 0) bucket_ = last_of_row();
  ++bucket_;
  if ((bucket_ & in_row_) == 0) next_row();
  auto& bucket = buckets_[static_cast<std::size_t>(bucket_ & in_row_)];
  in_buckets_ -= bucket.size();
  current_.swap(bucket);
}

// Spreads the row that begins with the bucket at hand.
void EventQueue::next_row() {
  const std::int64_t row = bucket_ >> row_shift_;
  if ((row & (kRows / 2 - 1)) == 0) {
    // Twice a turn of the ring, what has come within its reach moves in.
    for (const Event& event : std::exchange(later_, {})) add_to_row(event, bucket_of(event.time));
  }
  for (Chunk* chunk = std::exchange(row_of(bucket_), nullptr); chunk;) {
    for (std::size_t k = 0; k < chunk->size; ++k) {
      const Event& event = chunk->events[k];
      buckets_[static_cast<std::size_t>(bucket_of(event.time) & in_row_)].push_back(event);
    }
    in_rows_ -= chunk->size;
    in_buckets_ += chunk->size;
    Chunk* const next = chunk->next;
    chunk->next = std::exchange(spare_, chunk);
    chunk = next;
  }
}

}  // namespace clatter
