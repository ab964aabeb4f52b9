#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace clatter {

/// A run's sums as a series of parts in time. The number of parts stays bounded for any length of
/// the run: when it reaches the maximum, neighbouring parts are merged in pairs, and later parts
/// are twice as long. `Sums` has bytes() and +=.
template <class Sums, std::size_t Max = 64>
class PartSums {
 public:
  /// Maximum number of parts, even. If these took more than kMaxBytes, the maximum is lower, but at
  /// least 2.
  static constexpr std::size_t kMaxParts = Max;
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

  /// Maximum number of parts of `bytes` each. It is even, so that each part has a neighbour.
  static std::size_t max_parts(std::size_t bytes) {
    const std::size_t parts = kMaxBytes / std::max<std::size_t>(1, bytes);
    return std::clamp<std::size_t>(parts, 2, kMaxParts) / 2 * 2;
  }

  /// Adds a window of time. All windows have the same length and size.
  void add(Sums window) {
    if (windows_ % windows_per_part_ != 0) {
      parts_.back() += window;
    } else {
      if (parts_.size() == max_parts(window.bytes())) join_neighbours();
      parts_.push_back(std::move(window));
    }
    ++windows_;
  }

  /// The parts in order of time; the last may be shorter than the others.
  const std::vector<Sums>& parts() const { return parts_; }
  /// The number of windows per part; the last part may have fewer.
  std::uint64_t windows_per_part() const { return windows_per_part_; }

  /// Visits all members, for checkpoints.
  template <class Archive>
  void visit(Archive& io) {
    auto& [parts, windows_per_part, windows] = *this;
    io(parts, windows_per_part, windows);
    io.require(windows_per_part > 0 && parts.size() <= kMaxParts);
  }

 private:
  void join_neighbours() {
    for (std::size_t k = 0; 2 * k < parts_.size(); ++k) {
      Sums joined = std::move(parts_[2 * k]);
      joined += parts_[2 * k + 1];
      parts_[k] = std::move(joined);
    }
    parts_.resize(parts_.size() / 2);
    windows_per_part_ *= 2;
  }

  std::vector<Sums> parts_;
  std::uint64_t windows_per_part_ = 1;
  std::uint64_t windows_ = 0;  // in all parts
};

}  // namespace clatter
