#include <doctest/doctest.h>

#include <cmath>

#include "engine/live/pace.h"

using namespace clatter;

namespace {

Pace::Clock::time_point at(double seconds) {
  return Pace::Clock::time_point(std::chrono::duration_cast<Pace::Clock::duration>(
      std::chrono::duration<double>(1000.0 + seconds)));
}

double seconds(Pace::Clock::time_point time) {
  return std::chrono::duration<double>(time - at(0.0)).count();
}

}  // namespace

TEST_CASE("Pace: frames of an engine that holds the speed are even in both times") {
  Pace pace(50.0);
  pace.set_speed(3.0);
  double now = 0.0, time = 7.0;
  for (int frame = 1; frame <= 200; ++frame) {
    const Pace::Goal goal = pace.next(at(now), time);
    CHECK(seconds(goal.due) == doctest::Approx(0.02 * frame).epsilon(1e-6));
    CHECK(goal.time == doctest::Approx(7.0 + 0.06 * frame).epsilon(1e-9));
    time = goal.time;
    now = 0.02 * frame + 0.003;  // a slightly late wake-up
  }
  CHECK(pace.held() == doctest::Approx(1.0).epsilon(0.01));
}

TEST_CASE("Pace: time that an engine cannot hold is given up, and reported") {
  Pace pace(50.0);
  pace.set_speed(4.0);
  double time = 0.0;
  for (int frame = 0; frame < 200; ++frame) {
    const Pace::Goal goal = pace.next(at(0.02 * frame), time);
    CHECK(goal.time == doctest::Approx(time + 0.08));
    time += 0.02;  // a quarter
  }
  CHECK(pace.held() == doctest::Approx(0.25).epsilon(0.05));
  // Once it can, it keeps the speed again, without catching up.
  const Pace::Goal goal = pace.next(at(4.0), time);
  CHECK(goal.time == doctest::Approx(time + 0.08));
  pace.restart();
  CHECK(pace.held() == 1.0);
}

TEST_CASE("Pace: factors change the speed in both directions") {
  // Factor 1 up to t = 10, a quarter from 11 on; between them its square is linear.
  Pace pace(50.0);
  pace.set_speed(2.0);
  pace.set_factors({{10.0, 1.0}, {11.0, 0.25}});
  CHECK(pace.speed_at(9.0) == 2.0);
  CHECK(pace.speed_at(12.0) == 0.5);
  CHECK(pace.speed_at(-9.0) == 2.0);
  CHECK(pace.speed_at(-12.0) == 0.5);
  const double middle = 2.0 * std::sqrt(0.5 * (1.0 + 0.0625));
  CHECK(pace.speed_at(10.5) == doctest::Approx(middle));
  CHECK(pace.speed_at(-10.5) == doctest::Approx(middle));
  double time = 9.9;
  for (int frame = 0; frame < 100; ++frame) {
    const double next = pace.next(at(0.02 * frame), time).time;
    const double mean = 0.5 * (pace.speed_at(time) + pace.speed_at(next));
    CHECK(next - time == doctest::Approx(0.02 * mean).epsilon(0.01));
    time = next;
  }
  CHECK(time > 11.0);
  CHECK(pace.held() == doctest::Approx(1.0).epsilon(0.01));
  // Back over the same stretch in the same number of frames.
  pace.restart();
  double back = -time;
  for (int frame = 0; frame < 100; ++frame) back = pace.next(at(10.0 + 0.02 * frame), back).time;
  CHECK(-back == doctest::Approx(9.9).epsilon(1e-9));
}
