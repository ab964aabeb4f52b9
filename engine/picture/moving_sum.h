#pragma once

#include <deque>
#include <utility>

namespace clatter {

/// Number of parts of a moving window of time.
inline constexpr int kWindowParts = 8;

/// Sums over a window of time that moves part by part. `Sums` needs +=; a default-constructed one
/// is 0.
template <class Sums>
class MovingSum {
 public:
  /// Adds the sums since the last call.
  void add(const Sums& sums) { open_ += sums; }
  /// Begins a new part; drops the part that is older than the window.
  void next_part() {
    parts_.push_back(std::exchange(open_, {}));
    if (parts_.size() > kWindowParts) parts_.pop_front();
  }
  /// Sum over the window and the current part.
  Sums sum() const {
    Sums sum = open_;
    for (const Sums& part : parts_) sum += part;
    return sum;
  }
  /// Whether the sum covers a whole window.
  bool whole() const { return parts_.size() == kWindowParts; }

  /// Visits all members, for checkpoints.
  template <class Archive>
  void visit(Archive& io) {
    auto& [parts, open] = *this;
    io(parts, open);
  }

 private:
  std::deque<Sums> parts_;  // closed, oldest first
  Sums open_{};             // the current part
};

}  // namespace clatter
