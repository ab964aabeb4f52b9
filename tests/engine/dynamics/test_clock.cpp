#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "engine/dynamics/clock.h"
#include "engine/physics/random.h"

using namespace clatter;

// Bits beyond the 64 that ISO C++ has; what follows is exact arithmetic in units of a power of two.
__extension__ typedef __int128 Integer;

TEST_CASE("clock: a simulation time comes back from the base unchanged") {
  Random random(51, Stream::Velocity, 0, 0);
  for (const double start : {0.0, 1e9, 1e12}) {
    Clock clock(start);
    for (int i = 0; i < 10000; ++i) {
      const double absolute = clock.absolute(100.0 * random.uniform());
      REQUIRE(clock.absolute(clock.relative(absolute)) == absolute);
      clock.advance(random.uniform());
    }
  }
}

// Moves of whole multiples of 2^-40 up to 1e12 + 1e5 fit 128 bits, so the base is known exactly:
// the time on it must be the exact difference, which has few bits.
TEST_CASE("clock: a time on the base is exact after many moves") {
  for (const std::int64_t start : {0ll, 1000000000ll, 1000000000000ll}) {
    Random random(52, Stream::Velocity, 0, 0);
    Clock clock(static_cast<double>(start));
    Integer base = static_cast<Integer>(start) << 40;
    for (int i = 0; i < 100000; ++i) {
      const auto moved = static_cast<std::int64_t>(random.below(1ull << 41));
      clock.advance(std::ldexp(static_cast<double>(moved), -40));
      base += moved;
      const std::int64_t whole = start + i + static_cast<std::int64_t>(random.below(100));
      const Integer exact = (static_cast<Integer>(whole) << 40) - base;
      REQUIRE(clock.relative(static_cast<double>(whole)) ==
              std::ldexp(static_cast<double>(exact), -40));
    }
  }
}

TEST_CASE("clock: start + count * interval is exact up to 1e15 counts") {
  // .1 is 0x1.999999999999ap-4 = tenth * 2^-56; the base lies at a multiple of 2^-40.
  constexpr std::int64_t tenth = 0x1999999999999a;
  REQUIRE(std::ldexp(static_cast<double>(tenth), -56) == 0.1);
  Random random(53, Stream::Velocity, 0, 0);
  for (const std::uint64_t count :
       {1ull, 3ull, 12345ull, 987654321ull, 999999999999ull, 1000000000000000ull}) {
    for (const double start : {0.0, 0.5, 1e9}) {
      const Integer exact_time =
          static_cast<Integer>(tenth) * count + (static_cast<Integer>(std::ldexp(start, 20)) << 36);
      // A base that ends up to 50 before that time.
      Clock clock(start);
      const double near = std::floor(0.1 * static_cast<double>(count));
      const auto below = static_cast<std::int64_t>(random.below(50ull << 40));
      clock.advance(near);
      clock.advance(-std::ldexp(static_cast<double>(below), -40));
      const Integer base = (static_cast<Integer>(std::ldexp(start, 20)) << 36) +
                           (static_cast<Integer>(near) << 56) - (static_cast<Integer>(below) << 16);
      const double exact = std::ldexp(static_cast<double>(exact_time - base), -56);
      const double got = clock.relative(start, count, 0.1);
      CHECK(std::fabs(got - exact) <= 0x1p-53 * std::fabs(exact));
    }
  }
}
