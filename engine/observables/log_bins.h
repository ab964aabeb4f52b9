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

}  // namespace clatter
