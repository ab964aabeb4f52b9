#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace clatter {

/// Bins for positive numbers of any size: kPerOctave equal bins between consecutive powers of 2.
/// The first and the last bin also count smaller and larger numbers.
struct LogBins {
  static constexpr int kPerOctave = 8;
  static constexpr int kMinExponent = -64;  ///< of the lower edge of the first bin, as power of 2
  static constexpr int kMaxExponent = 32;   ///< of the upper edge of the last bin
  static constexpr std::size_t kCount = kPerOctave * (kMaxExponent - kMinExponent);

  /// The bin of a number >= 0: its exponent and the first three bits of its mantissa.
  static std::size_t of(double number) {
    constexpr int kMantissa = 52, kOctaveBits = std::countr_zero(unsigned{kPerOctave});
    constexpr auto kFirst = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(0x1p-64) >>
                                                      (kMantissa - kOctaveBits));
    static_assert(kMinExponent == -64);
    const auto bits = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(number) >>
                                                (kMantissa - kOctaveBits));
    return static_cast<std::size_t>(
        std::clamp<std::int64_t>(bits - kFirst, 0, static_cast<std::int64_t>(kCount) - 1));
  }

  /// Lower edge of a bin. The upper edge is that of the next bin.
  static double edge(std::size_t bin) {
    const auto octave = static_cast<int>(bin / kPerOctave);
    const double share = static_cast<double>(bin % kPerOctave) / kPerOctave;
    return std::ldexp(1.0 + share, kMinExponent + octave);
  }
};

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
