#include "engine/dynamics/event_queue.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/free_memory.h"

namespace clatter {

void EventQueue::rebuild(std::vector<Event>& events) {
  spread(events, events.size() / 4);
}

// The bucket width holds five of the first events on average. About two of these are stale when
// their bucket becomes current.
void EventQueue::spread(std::vector<Event>& events, std::size_t first) {
  current_.clear();
  moved_aside_ = 0;
  for (auto& bucket : buckets_) bucket.clear();
  in_buckets_ = in_rows_ = 0;
  rows_.assign(kRows, nullptr);
  spare_ = nullptr;
  if (events.empty()) chunks_.clear();
  for (Chunk& chunk : chunks_) chunk.next = std::exchange(spare_, &chunk);
  later_.clear();
  free_memory(arrived_);  // a burst may have taken much
  bucket_ = 0;
  empty_ = 0;
  if (events.empty()) return;

  const auto last = events.begin() + static_cast<std::ptrdiff_t>(first);
  const auto sooner = [](const Event& a, const Event& b) { return a.time < b.time; };
  std::nth_element(events.begin(), last, events.end(), sooner);
  origin_ = std::min_element(events.begin(), last + 1, sooner)->time;
  const double width = 5.0 * (last->time - origin_) / static_cast<double>(first + 1);
  per_width_ = width > 0.0 && std::isfinite(1.0 / width) ? 1.0 / width : 1.0;

  for (const Event& event : events) {
    if (bucket_of(event.time) == bucket_) {
      current_.push_back(event);
    } else {
      put_away(event);
    }
  }
  sort_current();
}

// Stores an event of a bucket after the current one.
void EventQueue::put_away(const Event& event) {
  const std::int64_t number = bucket_of(event.time);
  if (number > last_of_row()) {
    add_to_row(event, number);
  } else {
    buckets_[static_cast<std::size_t>(number & kInRow)].push_back(event);
    ++in_buckets_;
  }
}

// Inserts the last event into the others, which are sorted with the earliest last. Returns the
// number of events that it passes.
static std::size_t insert_last(Event* events, std::size_t size, const std::uint32_t* numbers) {
  const Event event = events[size - 1];
  std::size_t at = size - 1;
  for (; at > 0 && before(events[at - 1], event, numbers); --at) events[at] = events[at - 1];
  events[at] = event;
  return size - 1 - at;
}

// Exchanges two events unless the later one comes first. Branch-free, because the order is
// unpredictable.
static void put_later_first(Event& a, Event& b, const std::uint32_t* numbers) {
  using Words = std::array<std::uint64_t, 2>;
  static_assert(sizeof(Words) == sizeof(Event));
  const bool tied = a.time == b.time;
  bool exchange = a.time < b.time;
  if (tied) [[unlikely]]
    exchange = before(a, b, numbers);
  const std::uint64_t mask = -std::uint64_t{exchange};
  auto of_a = std::bit_cast<Words>(a), of_b = std::bit_cast<Words>(b);
  for (int k = 0; k < 2; ++k) {
    const std::uint64_t change = (of_a[k] ^ of_b[k]) & mask;
    of_a[k] ^= change;
    of_b[k] ^= change;
  }
  a = std::bit_cast<Event>(of_a);
  b = std::bit_cast<Event>(of_b);
}

void EventQueue::sort_current() {
  constexpr std::size_t kFew = 8;
  if (current_.size() <= kFew) {
    Event* const events = current_.data();
    for (std::size_t end = current_.size(); end >= 2; --end) {
      for (std::size_t k = 1; k < end; ++k) put_later_first(events[k - 1], events[k], numbers_);
    }
  } else {
    std::sort(current_.begin(), current_.end(),
              [this](const Event& a, const Event& b) { return before(b, a, numbers_); });
  }
}

// The current bucket normally holds a few events. A few hot particles among many cold ones can
// crowd it. The calendar is then rebuilt before the crowding has cost more than a rebuild.
void EventQueue::push_current(Event event) {
  current_.push_back(event);
  moved_aside_ += insert_last(current_.data(), current_.size(), numbers_);
  constexpr std::size_t kCrowd = 64;
  if (current_.size() > kCrowd && moved_aside_ > 8 * (current_.size() + beyond_current())) {
    const std::size_t crowd = current_.size();
    std::vector<Event> events = take_all();
    spread(events, crowd - 1);
  }
}

// All events; the calendar then needs new ones.
std::vector<Event> EventQueue::take_all() {
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
  take(arrived_);
  return events;
}

void EventQueue::add_to_row(const Event& event, std::int64_t bucket) {
  if ((bucket >> kRowShift) - (bucket_ >> kRowShift) >= kRows) {
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
  for (const Event& event : arrived_) put_away(event);
  arrived_.clear();
  if (in_buckets_ + in_rows_ == 0) {
    // Buckets and rows are empty: rebuild with a width from the events beyond them.
    std::vector<Event> events = std::exchange(later_, {});
    rebuild(events);
    return;
  }
  if (in_buckets_ == 0) bucket_ = last_of_row();
  ++bucket_;
  if ((bucket_ & kInRow) == 0) next_row();
  auto& bucket = buckets_[static_cast<std::size_t>(bucket_ & kInRow)];
  in_buckets_ -= bucket.size();
  current_.swap(bucket);
  // Buckets are too narrow if the first events at the last rebuild were closer in time than usual.
  // That is so after the start of a dense mixture, where many particles nearly touch.
  empty_ += current_.empty();
  if (empty_ > beyond_current() / 2 + kBuckets) {
    std::vector<Event> events = take_all();
    rebuild(events);
  }
}

// Spreads the row that begins with the current bucket over the buckets.
void EventQueue::next_row() {
  const std::int64_t row = bucket_ >> kRowShift;
  if ((row & (kRows / 2 - 1)) == 0) {
    // Twice per turn of the ring, events that are now within its range enter the rows.
    for (const Event& event : std::exchange(later_, {})) add_to_row(event, bucket_of(event.time));
  }
  for (Chunk* chunk = std::exchange(row_of(bucket_), nullptr); chunk;) {
    for (std::size_t k = 0; k < chunk->size; ++k) {
      const Event& event = chunk->events[k];
      buckets_[static_cast<std::size_t>(bucket_of(event.time) & kInRow)].push_back(event);
    }
    in_rows_ -= chunk->size;
    in_buckets_ += chunk->size;
    Chunk* const next = chunk->next;
    chunk->next = std::exchange(spare_, chunk);
    chunk = next;
  }
}

}  // namespace clatter
