#pragma once

#include <deque>
#include <utility>

namespace clatter {

/// Parts of a moving window of time.
inline constexpr int kWindowParts = 8;

/// What is summed up over a window of time that moves on by one part of it after the other. Sums
/// add up by +=, and an empty one is 0.
template <class Sums>
class MovingSum {
 public:
  /// Adds what came since the last call.
  void add(const Sums& sums) { open_ += sums; }
  /// Begins a further part; what is more than a window ago no longer counts.
  void next_part() {
    parts_.push_back(std::exchange(open_, {}));
    if (parts_.size() > kWindowParts) parts_.pop_front();
  }
  /// All of the window, and of the part under way.
  Sums sum() const {
    Sums sum = open_;
    for (const Sums& part : parts_) sum += part;
    return sum;
  }
  /// Whether that reaches back by a whole window.
  bool whole() const { return parts_.size() == kWindowParts; }

  /// What a checkpoint keeps: all of it.
  template <class Archive>
  void visit(Archive& io) {
    auto& [parts, open] = *this;
    io(parts, open);
  }

 private:
  std::deque<Sums> parts_;  // closed, oldest first
  Sums open_{};             // under way
};

}  // namespace clatter
