#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "engine/dynamics/event.h"

namespace clatter {

/// The calendar: a ladder queue. Events of the far future lie unsorted in rows, the row at hand is
/// spread over buckets, and the bucket at hand is sorted; an event moves down once per rung,
/// so push and pop cost O(1) at any number of disks. Events are never taken out early: the caller
/// says which are still live, and the others are dropped as they come up.
class EventQueue {
 public:
  /// Replaces the contents and chooses the bucket width from how dense the first events lie.
  void rebuild(std::vector<Event>& events);

  /// Adds an event at a finite time.
  void push(const Event& event);

  /// The earliest live event (in the order of `before`), or null where none is left. It stays until
  /// pop(). `live(event)` says whether an event still holds.
  template <typename Live>
  const Event* top(const Live& live);

  /// Takes out what top() returned.
  void pop() { current_.pop_back(); }

  /// Calls `visit` with each event of the bucket that comes `ahead` buckets after the one at hand,
  /// so that the caller can fetch what they will need.
  template <typename Visit>
  void look_ahead(std::size_t ahead, const Visit& visit) const;

  /// Number of the bucket at hand; changes when top() moves on.
  std::uint64_t bucket() const { return bucket_; }

 private:
  static constexpr std::size_t kRows = 1024;
  static constexpr std::size_t kInsertedUpTo = 16;  // events of a bucket; more are sorted at once
  static constexpr std::uint32_t kNone = 0xffffffffu;
  // Rows grow by chunks from a common store, so that memory follows what is planned and not what
  // each row once held.
  struct Chunk {
    std::uint32_t size = 0;
    std::uint32_t next = kNone;
    std::array<Event, 63> events;
  };

  std::uint64_t bucket_of(double time) const;
  void push_current(const Event& event);
  void next_bucket();
  void spread_row();
  void add_to_row(const Event& event, std::uint64_t bucket);

  double per_width_ = 1.0;      // buckets per time
  double origin_ = 0.0;         // time at which bucket 0 starts
  std::uint64_t bucket_ = 0;    // number of the bucket at hand
  unsigned row_shift_ = 8;      // log2 of the buckets per row
  std::vector<Event> current_;  // the bucket at hand, the earliest last
  // [1 << row_shift_] of the row at hand
  std::vector<std::vector<Event>> buckets_ = std::vector<std::vector<Event>>(1u << row_shift_);
  // [kRows], a ring over the coming rows: their newest chunks
  std::vector<std::uint32_t> rows_ = std::vector<std::uint32_t>(kRows, kNone);
  std::deque<Chunk> chunks_;  // of all rows
  std::vector<std::uint32_t> spare_chunks_;
  std::vector<Event> later_;  // beyond the last row
  std::size_t in_buckets_ = 0;
  std::size_t in_rows_ = 0;
};

template <typename Live>
const Event* EventQueue::top(const Live& live) {
  for (;;) {
    while (!current_.empty()) {
      if (live(current_.back())) return &current_.back();
      pop();
    }
    if (in_buckets_ + in_rows_ + later_.size() == 0) return nullptr;
    next_bucket();
  }
}

template <typename Visit>
void EventQueue::look_ahead(std::size_t ahead, const Visit& visit) const {
  const std::size_t in_row = (bucket_ & (buckets_.size() - 1)) + ahead;
  if (in_row >= buckets_.size()) return;
  for (const Event& event : buckets_[in_row]) visit(event);
}

}  // namespace clatter
