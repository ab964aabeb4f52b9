#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "engine/physics/fall_time.h"
#include "engine/physics/random.h"

using namespace clatter;

TEST_CASE("Fall time: it is the time computed by hand") {
  CHECK(fall_time(3.0, -2.0, 0.0) == 1.5);
  CHECK(fall_time(8.0, 0.0, -4.0) == 2.0);
  CHECK(fall_time(6.0, -1.0, -4.0) == 1.5);
  CHECK(fall_time(6.0, 4.0, -4.0) == 3.0);
  CHECK(fall_time(4.0, -5.0, 2.0) == 1.0);  // The first of the two passages, at 1 and 4.
}

TEST_CASE("Fall time: a height that never passes zero downwards gives never") {
  CHECK(fall_time(3.0, 0.0, 0.0) == kNever);
  CHECK(fall_time(3.0, -0.0, 0.0) == kNever);
  CHECK(fall_time(3.0, 2.0, 0.0) == kNever);
  CHECK(fall_time(3.0, 2.0, 1.0) == kNever);
  CHECK(fall_time(4.0, -3.0, 2.0) == kNever);  // Turns at a height of 1.75.
  CHECK(fall_time(4.0, -4.0, 2.0) == kNever);  // Turns at zero.
}

TEST_CASE("Fall time: a gap of zero, or below by rounding, closes at once if it shrinks") {
  for (const double gap : {0.0, -0.0, -1e-16}) {
    CHECK(fall_time(gap, -2.0, 0.0) == 0.0);
    CHECK(fall_time(gap, -2.0, 1.0) == 0.0);
    CHECK(fall_time(gap, -2.0, -1.0) == 0.0);
    CHECK(fall_time(gap, 0.0, -1.0) == 0.0);
    CHECK(fall_time(gap, 0.0, 0.0) == kNever);
    CHECK(fall_time(gap, 0.0, 1.0) == kNever);
    CHECK(fall_time(gap, 2.0, 0.0) == kNever);
    CHECK(fall_time(gap, 2.0, -0.5) == 8.0);
    CHECK(fall_time(gap, 1e-14, -0.5) == 4e-14);  // The rounding error exceeds the flight.
  }
}

TEST_CASE("Fall time: without acceleration it has the bits of the quotient") {
  int different = 0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(31, Stream::Velocity, i, 0);
    const double gap = std::exp(700.0 * random.uniform() - 350.0);
    const double speed = -std::exp(600.0 * random.uniform() - 560.0);
    different += std::bit_cast<std::uint64_t>(fall_time(gap, speed, 0.0)) !=
                 std::bit_cast<std::uint64_t>(gap / -speed);
  }
  CHECK(different == 0);
}

// The height at the passage is zero except for the rounding of the three terms and the time.
TEST_CASE("Fall time: it is precise where acceleration or speed hardly matters") {
  double worst = 0.0;
  int passages = 0;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    Random random(32, Stream::Velocity, i, 0);
    const double gap = std::exp(20.0 * random.normal());
    const double speed = (random.below(2) ? 1.0 : -1.0) * std::exp(20.0 * random.normal());
    const double acceleration = (random.below(4) ? -1.0 : 1.0) * std::exp(20.0 * random.normal());
    const double time = fall_time(gap, speed, acceleration);
    if (time == kNever) continue;
    ++passages;
    const double by_speed = speed * time, by_acceleration = 0.5 * acceleration * time * time;
    worst = std::max(worst, std::fabs(gap + by_speed + by_acceleration) /
                                (gap + std::fabs(by_speed) + std::fabs(by_acceleration)));
  }
  CHECK(passages > 80000);
  CHECK(worst < 5e-16);
}

TEST_CASE("Way out: it is the time computed by hand") {
  const auto is = [](const WayOut& out, double time, bool upper) {
    return out.time == time && out.upper == upper;
  };
  CHECK(is(exit_time(6.0, 9.0, 4.0, -4.0), 3.0, false));  // Turns at a height of 2.
  CHECK(is(exit_time(9.0, 6.0, -4.0, 4.0), 3.0, true));
  CHECK(is(exit_time(6.0, 2.0, 4.0, -4.0), 3.0, false));  // Touches the upper plane only.
  CHECK(is(exit_time(6.0, 1.5, 4.0, -4.0), 0.5, true));
  CHECK(is(exit_time(6.0, 1.0, -1.0, -4.0), 1.5, false));
  CHECK(is(exit_time(8.0, 1.0, 0.0, -4.0), 2.0, false));
  CHECK(is(exit_time(0.0, 1.0, -3.0, -4.0), 0.0, false));
  CHECK(is(exit_time(-1e-16, 5.0, 2.0, -0.5), 8.0, false));
  CHECK(is(exit_time(6.0, kNever, 4.0, -4.0), 3.0, false));
  CHECK(is(exit_time(kNever, 1.5, 4.0, -4.0), 0.5, true));
  for (const double rounding : {-1e-16, -0.0, 0.0}) {
    CHECK(is(exit_time(rounding, 1.0, -2.0, -0.5), 0.0, false));
    CHECK(is(exit_time(rounding, 1.0, 0.0, -0.5), 0.0, false));
    CHECK(is(exit_time(1.0, rounding, 2.0, -0.5), 0.0, true));
  }
  // A particle that falls away from the only plane never leaves.
  CHECK_FALSE(exit_time(kNever, kNever, -4.0, -4.0).time < kNever);
  CHECK_FALSE(exit_time(kNever, kNever, 4.0, -4.0).time < kNever);
  CHECK_FALSE(exit_time(kNever, 3.0, 4.0, -4.0).time < kNever);
}

TEST_CASE("Way out: it is the earlier of the times to fall to either plane") {
  constexpr int kCases = 100000;
  int upper = 0;
  double worst = 0.0;
  for (std::uint32_t i = 0; i < kCases; ++i) {
    Random random(33, Stream::Velocity, i, 0);
    const auto length = [&] { return std::exp(10.0 * random.normal()); };
    const auto either_sign = [&] { return (random.below(2) ? 1.0 : -1.0) * length(); };
    const double above = length(), below = length(), speed = either_sign(), a = either_sign();
    const WayOut out = exit_time(above, below, speed, a);
    const double down = fall_time(above, speed, a), up = fall_time(below, -speed, -a);
    const double time = std::min(down, up);
    REQUIRE(out.upper == (up < down));
    upper += out.upper;
    worst = std::max(worst, std::fabs(out.time - time) / time);
  }
  CHECK(std::abs(upper - kCases / 2) < kCases / 100);
  CHECK(worst < 1e-15);
}
