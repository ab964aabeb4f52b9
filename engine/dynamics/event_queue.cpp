#include "engine/dynamics/event_queue.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter {

static bool after(const Event& a, const Event& b) {
  return before(b, a);
}

void EventQueue::rebuild(std::vector<Event>& events) {
  current_.clear();
  later_.clear();
  rows_.assign(kRows, kNone);
  chunks_.clear();
  spare_chunks_.clear();
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

// By insertion: the bucket at hand holds some three events.
void EventQueue::push_current(const Event& event) {
  current_.push_back(event);
  std::size_t at = current_.size() - 1;
  for (; at > 0 && before(current_[at - 1], event); --at) current_[at] = current_[at - 1];
  current_[at] = event;
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
    add_to_row(event, number);
  } else {
    later_.push_back(event);
  }
}

void EventQueue::add_to_row(const Event& event, std::uint64_t bucket) {
  std::uint32_t& newest = rows_[(bucket >> row_shift_) & (kRows - 1)];
  if (newest == kNone || chunks_[newest].size == chunks_[newest].events.size()) {
    std::uint32_t added = static_cast<std::uint32_t>(chunks_.size());
    if (spare_chunks_.empty()) {
      chunks_.emplace_back();
    } else {
      added = spare_chunks_.back();
      spare_chunks_.pop_back();
    }
    chunks_[added].size = 0;
    chunks_[added].next = newest;
    newest = added;
  }
  Chunk& chunk = chunks_[newest];
  chunk.events[chunk.size++] = event;
  ++in_rows_;
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
  if (bucket.size() <= kInsertedUpTo) {
    for (const Event& event : bucket) push_current(event);
    bucket.clear();
  } else {
    current_.swap(bucket);
    std::sort(current_.begin(), current_.end(), after);
  }
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
      add_to_row(*event, bucket_of(event->time));
    }
    later_.erase(near, later_.end());
  }
  std::uint32_t& newest = rows_[row_number & (kRows - 1)];
  while (newest != kNone) {
    const Chunk& chunk = chunks_[newest];
    for (std::uint32_t k = 0; k < chunk.size; ++k) {
      const Event& event = chunk.events[k];
      buckets_[bucket_of(event.time) & (buckets_.size() - 1)].push_back(event);
    }
    in_rows_ -= chunk.size;
    in_buckets_ += chunk.size;
    spare_chunks_.push_back(newest);
    newest = chunk.next;
  }
}

}  // namespace clatter
