#include "engine/dynamics/event_queue.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter {

// Heaps of the standard library keep the largest in front, so the order is turned round.
static bool after(const Event& a, const Event& b) {
  return before(b, a);
}

void EventQueue::rebuild(std::vector<Event>& events) {
  current_.clear();
  later_.clear();
  for (auto& row : rows_) row.clear();
  for (auto& bucket : buckets_) bucket.clear();
  in_buckets_ = in_rows_ = 0;
  bucket_ = 0;
  if (events.empty()) return;

  // Three events a bucket, by the density of the first quarter of what is planned.
  const std::size_t quarter = events.size() / 4;
  std::nth_element(events.begin(), events.begin() + quarter, events.end(), before);
  origin_ = std::min_element(events.begin(), events.begin() + quarter + 1, before)->time;
  const double span = events[quarter].time - origin_;
  const double width = 3.0 * span / static_cast<double>(quarter + 1);
  per_width_ = width > 0.0 && std::isfinite(1.0 / width) ? 1.0 / width : 1.0;

  row_shift_ = 8;
  while (row_shift_ < 12 && (std::size_t{16} << row_shift_) < events.size()) ++row_shift_;
  buckets_.resize(std::size_t{1} << row_shift_);
  for (const Event& event : events) push(event);
}

std::uint64_t EventQueue::bucket_of(double time) const {
  const double number = (time - origin_) * per_width_;
  if (!(number > 0.0)) return 0;
  return number < 0x1p62 ? static_cast<std::uint64_t>(number) : std::uint64_t{1} << 62;
}

void EventQueue::push_current(const Event& event) {
  current_.push_back(event);
  std::push_heap(current_.begin(), current_.end(), after);
}

void EventQueue::push(const Event& event) {
  const std::uint64_t number = bucket_of(event.time);
  const std::uint64_t rows_ahead = (number >> row_shift_) - (bucket_ >> row_shift_);
  if (number <= bucket_) {
    push_current(event);
  } else if (rows_ahead == 0) {
    buckets_[number & (buckets_.size() - 1)].push_back(event);
    ++in_buckets_;
  } else if (rows_ahead < kRows) {
    rows_[(number >> row_shift_) & (kRows - 1)].push_back(event);
    ++in_rows_;
  } else {
    later_.push_back(event);
  }
}

void EventQueue::pop() {
  std::pop_heap(current_.begin(), current_.end(), after);
  current_.pop_back();
}

void EventQueue::next_bucket() {
  if (in_buckets_ + in_rows_ == 0) {
    // Nothing within reach: start afresh, at the width of what lies beyond.
    std::vector<Event> events = std::exchange(later_, {});
    rebuild(events);
    return;
  }
  if (in_buckets_ == 0) bucket_ |= buckets_.size() - 1;  // straight to the next row
  ++bucket_;
  if ((bucket_ & (buckets_.size() - 1)) == 0) spread_row();
  auto& bucket = buckets_[bucket_ & (buckets_.size() - 1)];
  in_buckets_ -= bucket.size();
  current_.swap(bucket);
  std::make_heap(current_.begin(), current_.end(), after);
}

void EventQueue::spread_row() {
  const std::uint64_t row_number = bucket_ >> row_shift_;
  if ((row_number & (kRows / 2 - 1)) == 0) {
    // Twice a turn of the ring, what has come within its reach moves in.
    const auto far = [&](const Event& event) {
      return (bucket_of(event.time) >> row_shift_) - row_number >= kRows;
    };
    const auto near = std::partition(later_.begin(), later_.end(), far);
    for (auto event = near; event != later_.end(); ++event) {
      rows_[(bucket_of(event->time) >> row_shift_) & (kRows - 1)].push_back(*event);
    }
    in_rows_ += static_cast<std::size_t>(later_.end() - near);
    later_.erase(near, later_.end());
  }
  auto& row = rows_[row_number & (kRows - 1)];
  for (const Event& event : row) {
    buckets_[bucket_of(event.time) & (buckets_.size() - 1)].push_back(event);
  }
  in_rows_ -= row.size();
  in_buckets_ += row.size();
  row.clear();
}

}  // namespace clatter
