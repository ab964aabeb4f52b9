#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "engine/dynamics/event.h"

namespace clatter {

/// The calendar: a ladder queue. Events of the far future lie unsorted in rows, the row at hand is
/// spread over buckets, and the bucket at hand is sorted; an event moves down once per rung,
/// so push and pop cost O(1) at any number of particles. Events are never taken out early: the
/// caller says which are still live, and the others are dropped as they come up.
class EventQueue {
 public:
  EventQueue() = default;
  EventQueue(const EventQueue&) = delete;
  EventQueue& operator=(const EventQueue&) = delete;

  /// Replaces the contents and chooses the bucket width from how dense the first events lie.
  void rebuild(std::vector<Event>& events);

  /// Adds an event at a finite time.
  void push(Event event);

  /// The earliest live event (in the order of `before`), or null where none is left. It stays until
  /// pop(). `live(event)` says whether an event still holds.
  template <typename Live>
  const Event* top(const Live& live);

  /// Takes out what top() returned.
  void pop() { current_.pop_back(); }

  /// Calls `visit` with each event of the bucket that comes `ahead` buckets after the one at hand,
  /// so that the caller can prefetch what they will need; but for events pushed since the bucket at
  /// hand came up.
  template <typename Visit>
  void look_ahead(std::size_t ahead, const Visit& visit) const;

  /// Number of the bucket at hand; changes when top() moves on.
  std::int64_t bucket() const { return bucket_; }

 private:
  // Measured best from N = 10^3 to 10^6: the fewer the buckets of the row at hand, the more of the
  // second cache they leave to the particles, but the more events lie in rows and are moved once
  // more.
  static constexpr unsigned kRowShift = 9;  // log2 of the buckets per row
  // The bits of a bucket's number that say which of its row it is.
  static constexpr std::int64_t kInRow = (std::int64_t{1} << kRowShift) - 1;
  // So many that a gas of 10^6 particles plans little beyond them.
  static constexpr std::int64_t kRows = 2048;
  // Rows grow by chunks from a common store, so that memory follows what is planned and not what
  // each row once held.
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
  void thin_out();
  void put_away(const Event& event);
  void next_bucket();
  void next_row();
  void add_to_row(const Event& event, std::int64_t bucket);
  Chunk* add_chunk(Chunk* next);

  double per_width_ = 1.0;       // buckets per time
  double origin_ = 0.0;          // time at which bucket 0 starts
  std::int64_t bucket_ = 0;      // number of the bucket at hand
  std::vector<Event> current_;   // the bucket at hand, the earliest last
  std::size_t moved_aside_ = 0;  // events, to make room for others in current_
  std::array<std::vector<Event>, kInRow + 1> buckets_;  // of the row at hand
  // [kRows], a ring over the coming rows: their newest chunks, or null
  std::vector<Chunk*> rows_ = std::vector<Chunk*>(kRows);
  std::deque<Chunk> chunks_;  // of all rows
  Chunk* spare_ = nullptr;    // chunks not in use
  std::vector<Event> later_;  // beyond the last row
  // For later buckets, since the one at hand came up: put away when the next one does, for where to
  // cannot be foreseen, and their times are long known then.
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

// Without branches, for which are dead cannot be foreseen.
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
