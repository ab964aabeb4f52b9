#pragma once

#include <array>
#include <atomic>

namespace clatter {

/// Passes the newest value from one thread to another; neither thread ever waits. Of three slots
/// one belongs to the writer and one to the reader; the third holds the last published value.
template <class T>
class TripleBuffer {
 public:
  /// The writer's slot. It holds an older value and must be filled before each publish().
  T& back() { return slots_[back_]; }
  /// Publishes the content of the writer's slot.
  void publish() { back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh; }

  /// Takes the last published value; returns whether it is new to the reader.
  bool update() {
    if (!(middle_.load(std::memory_order_relaxed) & kFresh)) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & ~kFresh;
    return true;
  }
  /// The reader's slot: the value of update(), initially T().
  const T& front() const { return slots_[front_]; }

 private:
  static constexpr unsigned kFresh = 4;

  std::array<T, 3> slots_{};
  std::atomic<unsigned> middle_ = 1;  // index of the third slot, and whether it is new
  alignas(64) unsigned back_ = 0;     // the writer's
  alignas(64) unsigned front_ = 2;    // the reader's
};

}  // namespace clatter
