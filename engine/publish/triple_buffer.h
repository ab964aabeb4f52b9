#pragma once

#include <array>
#include <atomic>

namespace clatter {

/// Hands the newest value from one thread to another; neither ever waits. Of three slots one is the
/// writer's, one the reader's, and the third holds what was published last.
template <class T>
class TripleBuffer {
 public:
  /// The writer's slot, to be filled anew before each publish(): it holds some older value.
  T& back() { return slots_[back_]; }
  /// Hands over what the writer's slot holds.
  void publish() { back_ = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh; }

  /// Takes what was published last; whether it is new to the reader.
  bool update() {
    if (!(middle_.load(std::memory_order_relaxed) & kFresh)) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & ~kFresh;
    return true;
  }
  /// The reader's slot: what update() took, or T() before.
  const T& front() const { return slots_[front_]; }

 private:
  static constexpr unsigned kFresh = 4;

  std::array<T, 3> slots_{};
  std::atomic<unsigned> middle_ = 1;  // index of the slot between them, and whether it is news
  alignas(64) unsigned back_ = 0;     // the writer's
  alignas(64) unsigned front_ = 2;    // the reader's
};

}  // namespace clatter
