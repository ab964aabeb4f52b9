#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "engine/dynamics/clock.h"
#include "engine/dynamics/regular_times.h"
#include "engine/physics/random.h"

using namespace clatter;

// 128-bit integers, which ISO C++ does not have, for exact arithmetic in units of a power of two.
__extension__ typedef __int128 Integer;

TEST_CASE("Clock: a simulation time comes back from the base unchanged") {
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

// Moves by multiples of 2^-40 up to 1e12 + 1e5 fit 128 bits, so that the base is known exactly. A
// time relative to it must be the exact difference, which has few bits.
TEST_CASE("Clock: a time on the base is exact after many moves") {
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

TEST_CASE("Clock: tenths of a time unit are exact up to 1e15 of them") {
  // Whole numbers are multiples of 2^-56. The base is a multiple of 2^-40.
  Random random(53, Stream::Velocity, 0, 0);
  for (const std::uint64_t count :
       {1ull, 3ull, 12345ull, 987654321ull, 999999999999ull, 1000000000000000ull}) {
    for (const double start : {0.0, 0.5, 1e9}) {
      const Integer tenths = (static_cast<Integer>(count) << 56) +
                             ((static_cast<Integer>(std::ldexp(start, 20)) << 36) * 10);
      // A base at most 50 before this time.
      Clock clock(start);
      const double near = std::floor(0.1 * static_cast<double>(count));
      const auto below = static_cast<std::int64_t>(random.below(50ull << 40));
      clock.advance(near);
      clock.advance(-std::ldexp(static_cast<double>(below), -40));
      const Integer base = (static_cast<Integer>(std::ldexp(start, 20)) << 36) +
                           (static_cast<Integer>(near) << 56) - (static_cast<Integer>(below) << 16);
      const long double exact = std::ldexp(static_cast<long double>(tenths - 10 * base) / 10, -56);
      const double got = clock.relative(RegularTimes(start, 0.1).exactly(count));
      CHECK(std::fabs(got - exact) <= 0x1.01p-53 * std::fabs(exact));
    }
  }
}

TEST_CASE("Clock: an interval near the largest double has a start and no end") {
  Clock clock(7.0);
  clock.advance(0.1);
  for (const double interval : {1e280, 1e303, 1e308}) {
    CAPTURE(interval);
    CHECK(clock.relative(RegularTimes(9.0, interval).exactly(0)) == clock.relative(9.0));
    CHECK(clock.relative(RegularTimes(9.0, interval).exactly(1)) > 1e250);
    CHECK(clock.relative(RegularTimes(9.0, interval).exactly(1'000'000)) > 1e250);
  }
}

TEST_CASE("Clock: the phase at the base is exact for up to 1e18 periods") {
  CHECK(Clock(0.0).periods(3.0, 0.25) == 0.25);
  CHECK(Clock(0.75).periods(3.0, 0.0) == 0.25);
  CHECK(Clock(1.0).periods(3.5, 0.5) == 0.0);
  CHECK(Clock(1e12).periods(1e6, 0.625) == 0.625);
  CHECK(Clock(-0.25).periods(1.0, 0.0) == 0.75);
  // Frequencies are multiples of 2^-20 below 2^20, the base is a multiple of 2^-40. The product in
  // units of 2^-60 fits 128 bits.
  constexpr Integer period = static_cast<Integer>(1) << 60;
  for (const std::int64_t start : {0ll, 1000000000ll, 1000000000000ll}) {
    Random random(54, Stream::Velocity, 0, 0);
    Clock clock(static_cast<double>(start));
    Integer base = static_cast<Integer>(start) << 40;
    double worst = 0.0;
    for (int i = 0; i < 100000; ++i) {
      const auto moved = static_cast<std::int64_t>(random.below(1ull << 41));
      clock.advance(std::ldexp(static_cast<double>(moved), -40));
      base += moved;
      const auto frequency = static_cast<std::int64_t>(random.below(1ull << 40));
      const auto phase = static_cast<std::int64_t>(random.below(1ull << 40));
      const Integer exact = (frequency * base + (static_cast<Integer>(phase) << 20)) % period;
      const double got = clock.periods(std::ldexp(static_cast<double>(frequency), -20),
                                       std::ldexp(static_cast<double>(phase), -40));
      REQUIRE(got >= 0.0);
      REQUIRE(got < 1.0);
      const double error = std::fabs(got - std::ldexp(static_cast<double>(exact), -60));
      worst = std::max(worst, std::min(error, 1.0 - error));
    }
    CHECK(worst < 2.5e-16);
  }
}
