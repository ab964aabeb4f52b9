#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/observables/count_bins.h"
#include "engine/observables/log_bins.h"

namespace clatter {

/// The bins of LogBins for numbers of both signs. The two bins beside 0 also count smaller sizes.
struct SignedLogBins {
  static constexpr std::size_t kCount = 2 * LogBins::kCount;

  static std::size_t of(double number) {
    // Without a branch, because signs are random: ~bin is -1 - bin.
    const auto sign = static_cast<std::size_t>(number < 0.0);
    return LogBins::kCount + (LogBins::of(std::fabs(number)) ^ (std::size_t{0} - sign));
  }
  /// Lower edge of a bin. The upper edge is that of the next bin.
  static double edge(std::size_t bin) {
    if (bin == LogBins::kCount) return 0.0;
    return bin < LogBins::kCount ? -LogBins::edge(LogBins::kCount - bin)
                                 : LogBins::edge(bin - LogBins::kCount);
  }
};

/// The bins of CountBins for whole numbers of both signs.
struct SignedCountBins {
  static constexpr std::size_t kCount = 2 * CountBins::kCount;

  /// The bin of a number between -2^32 and 2^32.
  static std::size_t of(std::int64_t number) {
    return number < 0
               ? CountBins::kCount - 1 - CountBins::of(static_cast<std::uint64_t>(-number - 1))
               : CountBins::kCount + CountBins::of(static_cast<std::uint64_t>(number));
  }
  /// Lower edge of a bin, a whole number. The upper edge is that of the next bin.
  static double edge(std::size_t bin) {
    return bin < CountBins::kCount ? -CountBins::edge(CountBins::kCount - bin)
                                   : CountBins::edge(bin - CountBins::kCount);
  }
};

}  // namespace clatter
