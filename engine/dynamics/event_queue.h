#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "engine/dynamics/event.h"

// The calendar is a ladder queue with O(1) push and pop (event_queue.h). Rows hold the far future
// unsorted. The current row is spread over buckets. Only the current bucket is sorted. The width of
// the buckets follows from the density of the first events. Where a few hot particles crowd a
// bucket, or after about half as many empty buckets as events, the calendar is rebuilt.

namespace clatter {

/// The calendar of events, a ladder queue. Rows hold the far future unsorted, the current row is
/// spread over buckets, and the current bucket is sorted. An event moves down once per rung, so
/// push and pop cost O(1) for any number of particles. Stale events stay in the queue until their
/// time: the caller states which events are live, and the queue drops the others.
class EventQueue {
 public:
  EventQueue() = default;
  EventQueue(const EventQueue&) = delete;
  EventQueue& operator=(const EventQueue&) = delete;

  /// Orders simultaneous events by these original numbers of the particles, which must outlive the
  /// queue. Null: by the particles' own numbers.
  void order_by(const std::uint32_t* numbers) { numbers_ = numbers; }
  /// Replaces the contents; chooses the bucket width from the density of the first events.
  void rebuild(std::vector<Event>& events);

  /// Adds an event at a finite time.
  void push(Event event);

  /// Returns the earliest live event, or null without one. The order is that of `before`. The event
  /// stays in the queue until pop(). `live(event)` returns whether an event is still valid.
  template <typename Live>
  const Event* top(const Live& live);

  /// Removes the event that top() returned.
  void pop() { current_.pop_back(); }

  /// Calls `visit` with each event of the bucket `ahead` buckets after the current one, so that the
  /// caller can prefetch its data. Events pushed since the current bucket began are not included.
  template <typename Visit>
  void look_ahead(std::size_t ahead, const Visit& visit) const;

  /// Number of the current bucket; changes when top() enters the next bucket.
  std::int64_t bucket() const { return bucket_; }

 private:
  // Measured best from N = 10^3 to 10^6. Fewer buckets per row leave more of the L2 cache to the
  // particles. But then more events are in rows and are moved once more.
  static constexpr unsigned kRowShift = 9;  // log2 of the buckets per row
  // Mask of a bucket's number that gives its index in its row.
  static constexpr std::int64_t kInRow = (std::int64_t{1} << kRowShift) - 1;
  static constexpr std::size_t kBuckets = kInRow + 1;  // per row
  // Enough rows that a gas of 10^6 particles has few events beyond them.
  static constexpr std::int64_t kRows = 2048;
  // Rows grow by chunks from a common store. Memory then follows the number of planned events, not
  // the largest size of each row.
  struct Chunk {
    Chunk* next = nullptr;
    std::size_t size = 0;
    std::array<Event, 63> events;
  };

  std::int64_t bucket_of(double time) const;
  std::size_t beyond_current() const {
    return in_buckets_ + in_rows_ + later_.size() + arrived_.size();
  }
  std::int64_t last_of_row() const { return bucket_ | kInRow; }
  Chunk*& row_of(std::int64_t bucket) { return rows_[(bucket >> kRowShift) & (kRows - 1)]; }
  void spread(std::vector<Event>& events, std::size_t first);
  template <typename Live>
  void drop_dead(const Live& live);
  void sort_current();
  void push_current(Event event);
  std::vector<Event> take_all();
  void put_away(const Event& event);
  void next_bucket();
  void next_row();
  void add_to_row(const Event& event, std::int64_t bucket);
  Chunk* add_chunk(Chunk* next);

  const std::uint32_t* numbers_ = nullptr;
  double per_width_ = 1.0;       // buckets per time
  double origin_ = 0.0;          // time at which bucket 0 starts
  std::int64_t bucket_ = 0;      // number of the current bucket
  std::vector<Event> current_;   // the current bucket, the earliest event last
  std::size_t moved_aside_ = 0;  // events shifted by insertions into current_
  std::size_t empty_ = 0;        // buckets without events since the last rebuild
  std::array<std::vector<Event>, kBuckets> buckets_;  // of the current row
  // [kRows], a ring over the coming rows: their newest chunks, or null
  std::vector<Chunk*> rows_ = std::vector<Chunk*>(kRows);
  std::deque<Chunk> chunks_;  // of all rows
  Chunk* spare_ = nullptr;    // chunks not in use
  std::vector<Event> later_;  // beyond the last row
  // Events of later buckets, pushed since the current bucket began. They are sorted into buckets
  // and rows when the next bucket begins: their targets are unpredictable, and by then their times
  // are computed.
  std::vector<Event> arrived_;
  std::size_t in_buckets_ = 0;
  std::size_t in_rows_ = 0;
};

inline std::int64_t EventQueue::bucket_of(double time) const {
  const double number = (time - origin_) * per_width_;
  return static_cast<std::int64_t>(std::clamp(number, 0.0, 0x1p62));
}

inline void EventQueue::push(Event event) {
  if (bucket_of(event.time) > bucket_) {
    arrived_.push_back(event);
  } else {
    push_current(event);
  }
}

template <typename Live>
const Event* EventQueue::top(const Live& live) {
  for (;;) {
    while (!current_.empty()) {
      if (live(current_.back())) return &current_.back();
      pop();
    }
    if (beyond_current() == 0) return nullptr;
    next_bucket();
    drop_dead(live);
    sort_current();
  }
}

// Branch-free, because it is unpredictable which events are stale.
template <typename Live>
void EventQueue::drop_dead(const Live& live) {
  std::size_t kept = 0;
  for (const Event event : current_) {
    current_[kept] = event;
    kept += live(event);
  }
  current_.resize(kept);
}

template <typename Visit>
void EventQueue::look_ahead(std::size_t ahead, const Visit& visit) const {
  const std::size_t in_row = static_cast<std::size_t>(bucket_ & kInRow) + ahead;
  if (in_row >= buckets_.size()) return;
  for (const Event& event : buckets_[in_row]) visit(event);
}

}  // namespace clatter
