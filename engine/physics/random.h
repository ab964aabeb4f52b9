#pragma once

#include <array>
#include <cstdint>

namespace clatter {

/// Purpose of a random number. Streams of different purposes never share numbers.
enum class Stream : std::uint32_t { Placement, Velocity, ThermalWall, Kick, StartSpin, Puff };

/// Counter-based generator Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011): four random words of 32
/// bits, a pure function of counter and key.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// The random numbers of one item, for example the n-th wall hit of a particle. They do not depend
/// on numbers drawn for other items, so results do not depend on the order of calculation.
class Random {
 public:
  /// The numbers of item `item` < 2^56 of `owner` (a particle) in a stream of the run with this
  /// seed.
  Random(std::uint64_t seed, Stream stream, std::uint32_t owner, std::uint64_t item);

  /// Uniform in the open interval (0,1), 52 bits.
  double uniform();
  /// Standard normal (Box-Muller, both values used).
  double normal();
  /// Uniform in 0..n-1, n > 0.
  std::uint64_t below(std::uint64_t n);

 private:
  std::uint64_t bits();

  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> block_{};
  int left_ = 0;  // words of block_ not yet used
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace clatter
