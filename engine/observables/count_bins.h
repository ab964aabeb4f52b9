#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/observables/log_bins.h"

namespace clatter {

/// Bins for whole numbers >= 0: one for each number below 16, then eight equal bins between
/// consecutive powers of 2.
struct CountBins {
  /// Numbers below have own bins. Logarithmic bins from here to its double have one number each,
  /// too.
  static constexpr std::size_t kSingle = LogBins::kPerOctave;
  static constexpr std::size_t kCount = 256;

  /// The bin of a number below 2^32.
  static std::size_t of(std::uint64_t number) {
    return number < kSingle ? number : kSingle + LogBins::of(static_cast<double>(number)) - first();
  }
  /// Lower edge of a bin, a whole number. The upper edge is that of the next bin.
  static double edge(std::size_t bin) {
    return bin < kSingle ? static_cast<double>(bin) : LogBins::edge(bin - kSingle + first());
  }

 private:
  static std::size_t first() { return LogBins::of(static_cast<double>(kSingle)); }
};

}  // namespace clatter
