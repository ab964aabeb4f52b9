#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/physics/contact.h"
#include "tests/engine/support/wall_scan.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr WallPath kPaths[] = {WallPath::Sawtooth, WallPath::Sinusoidal};

}  // namespace

TEST_CASE("Wall motion: the wall is where its path says") {
  const WallMotion sawtooth{WallPath::Sawtooth, 3.0, 0.5, 0.25};
  CHECK(innermost_travel(sawtooth) == 3.0);
  for (const double time : {0.0, 2.0, -2.0, 2e6}) {
    const WallState wall = wall_state(sawtooth, time + 0.5);
    CHECK(wall.displacement == 1.5);
    CHECK(wall.velocity == 1.5);
    CHECK(wall.acceleration == 0.0);
    CHECK(wall_state(sawtooth, time + 1.5).displacement == 0.0);
  }
  // Rounding moves a time just before the jump to after it.
  CHECK(wall_state({WallPath::Sawtooth, 3.0, 0.5, 0.0}, -1e-20).displacement == 0.0);
  const WallMotion wave{WallPath::Sinusoidal, 3.0, 0.5, 0.25};
  CHECK(innermost_travel(wave) == 1.5);
  const double pi = std::numbers::pi;
  for (const double time : {0.0, 2.0, -2.0, 2e6}) {
    const WallState crest = wall_state(wave, time);
    CHECK(crest.displacement == 1.5);
    CHECK(std::fabs(crest.velocity) < 1e-15);
    CHECK(crest.acceleration == -1.5 * pi * pi);
    CHECK(wall_state(wave, time + 1.0).displacement == -1.5);
    CHECK(std::fabs(wall_state(wave, time + 1.5).displacement) < 1e-15);
    CHECK(wall_state(wave, time + 1.5).velocity == 1.5 * pi);
  }
}

TEST_CASE("Wall motion: a wall at rest is a plane") {
  for (const WallPath path : kPaths) {
    for (const WallMotion motion : {WallMotion{path, 0.0, 3.0, 0.25}, {path, 2.0, 0.0, 0.25}}) {
      const WallState wall = wall_state(motion, 7.0);
      CHECK(wall.velocity == 0.0);
      const double place = wall.displacement;
      CHECK(WallCase{motion, 7.0, place + 3.0, -2.0, 0.0}.contact() == 8.5);
      CHECK(WallCase{motion, 7.0, place + 3.0, 2.0, 0.0}.contact() == kNever);
      CHECK(WallCase{motion, 7.0, place + 3.0, 2.0, -2.0}.contact() == 10.0);
      CHECK(WallCase{motion, 7.0, place, -1e-300, 0.0}.contact() == 7.0);
      CHECK(WallCase{motion, 7.0, place, 0.0, 0.0}.contact() == kNever);
      CHECK(WallCase{motion, 7.0, place, 0.0, -1.0}.contact() == 7.0);
      CHECK(WallCase{motion, 7.0, place, 1.0, -1.0}.contact() == 9.0);
    }
  }
}

TEST_CASE("Wall motion: a saw-tooth hits at the times computed by hand") {
  const WallMotion wall{WallPath::Sawtooth, 2.0, 0.5, 0.0};  // of speed 1 and period 2
  CHECK(WallCase{wall, 0.0, 1.0, 0.0}.contact() == 1.0);
  CHECK(WallCase{wall, 0.0, 3.0, -1.0}.contact() == 1.5);
  CHECK(WallCase{wall, -4.0, 3.0, -1.0}.contact() == -2.5);
  CHECK(WallCase{wall, 0.0, 5.0, -1.0}.contact() == 3.5);
  CHECK(WallCase{wall, 2e6, 5.0, -1.0}.contact() == 2e6 + 3.5);
  CHECK(WallCase{wall, 0.0, 0.5, 0.5}.contact() == 1.0);     // the wall catches up
  CHECK(WallCase{wall, 0.0, 1.5, 0.5}.contact() == kNever);  // leaves before the wall arrives
  CHECK(WallCase{wall, 0.0, 2.0, 0.0}.contact() == kNever);  // out of reach
  CHECK(WallCase{wall, 1.0, 1.5, 0.1875, 0.0}.contact() == 1.0 + 0.5 / 0.8125);
  // Leaves the range of the wall and returns: 1 + 4t - t^2 = t - 2 on the second ramp.
  CHECK(WallCase{wall, 0.0, 1.0, 4.0, -2.0}.contact() == (3.0 + std::sqrt(21.0)) / 2.0);
}

TEST_CASE("Wall motion: a sinusoidal wall hits at the times computed by hand") {
  const WallMotion wall{WallPath::Sinusoidal, 2.0, 0.25, 0.0};  // of amplitude 1 and period 4
  const auto check = [&](double start, double distance, double speed, double acceleration,
                         double expected) {
    const double time = WallCase{wall, start, distance, speed, acceleration}.contact();
    CHECK(std::fabs(time - expected) < 4e-15);
  };
  check(0.0, 0.5, 0.0, 0.0, 1.0 / 3.0);
  check(-6.0, 0.5, 0.0, 0.0, -4.0 + 1.0 / 3.0);
  check(0.0, 2.0, -1.0, 0.0, 1.0);                       // at the crest
  check(0.0, 5.0, -2.0, 0.0, 3.0);                       // at the trough
  check(0.0, 0.25, 0.75, 0.0, 1.0 / 3.0);                // the wall catches up
  check(2.0, 0.5 - 7.0 / 24.0, 0.125, 0.0, 13.0 / 3.0);  // the wall catches up in the next period
  check(0.0, 6.0, 6.0, -2.0, 7.0);                       // leaves the range of the wall and returns
  CHECK(WallCase{wall, 0.0, 0.5, 2.0}.contact() == kNever);
  CHECK(WallCase{wall, 0.0, 1.0 + 1e-15, 0.0}.contact() == kNever);  // out of reach
  CHECK(WallCase{wall, 1.5, 0.75, 0.5}.contact() == kNever);  // leaves before the wall returns
  CHECK(WallCase{wall, 0.0, 10.0, -4.0, 1.0}.contact() == kNever);  // turns before the zone
}

TEST_CASE("Wall motion: touching particles are hit at once if the wall catches them up") {
  const WallMotion ramps{WallPath::Sawtooth, 2.0, 0.5, 0.0};
  for (const double overlap : {0.0, 1e-15}) {
    const auto contact = [&](double speed, double acceleration) {
      return WallCase{ramps, 1.0, 1.0 - overlap, speed, acceleration}.contact();
    };
    CHECK(contact(0.0, 0.0) == 1.0);
    CHECK(contact(0.0, 8.0) == 1.0);
    CHECK(contact(1.0 - 1e-14, 0.0) == 1.0);
    CHECK(contact(1.0, -1e-9) == 1.0);  // rides the wall under gravity
    CHECK(contact(1.0, 0.0) == kNever);
    CHECK(contact(1.0 - 1e-15, 0.0) == kNever);
    CHECK(contact(1.0 - 1e-15, 8.0) == kNever);
    CHECK(contact(2.0, 0.0) == kNever);
    CHECK(contact(2.0, -1.0) == 5.0);  // t - t^2/2 = -4 on the third ramp
  }
  // It rides the wall until the wall's acceleration changes sign at phase 1/2, and is hit later.
  const WallMotion wave{WallPath::Sinusoidal, 2.0, 0.25, 0.0};
  const auto ride = [&](double start) {
    const WallState wall = wall_state(wave, start);
    return WallCase{wave, start, wall.displacement, wall.velocity}.contact();
  };
  CHECK(ride(1.5) > 2.0);
  CHECK(ride(1.5) < 4.0);
  CHECK(ride(2.5) == 2.5);
}

// A wholly inelastic hit and the next one, with rounding errors of either sign, also of the wall's
// phase.
TEST_CASE("Wall motion: a particle that rides the wall is met there, up to rounding") {
  for (const WallPath path : kPaths) {
    Verdict verdict;
    for (std::uint32_t i = 0; i < 10000; ++i) {
      Random random(41, Stream::Velocity, i, 0);
      WallCase c = random_case(path, random);
      const WallState wall = wall_state(c.motion, c.start);
      c.distance = wall.displacement * (1.0 - kEpsilon * static_cast<double>(random.below(3)));
      c.speed = wall.velocity * (1.0 + kEpsilon * (random.uniform() - 0.5));
      verdict.add(c, c.contact());
    }
    verdict.check();
    CHECK(verdict.at_once > 1000);
  }
}

// One hop of a particle that leaves the wall at a speed near the rounding error, under
// accelerations towards the wall. It lasts 2 speed / acceleration, not zero.
TEST_CASE("Wall motion: the smallest hops come to their end, and not before") {
  for (const WallPath path : kPaths) {
    double longest = 0.0, shortest = kNever;
    for (std::uint32_t i = 0; i < 100000; ++i) {
      Random random(42, Stream::Velocity, i, 0);
      WallCase c = random_case(path, random);
      c.start = 0.0;
      const WallState wall = wall_state(c.motion, 0.0);
      c.acceleration = -std::fabs(c.acceleration) - 0.1 * c.peak_speed() * c.motion.frequency;
      const double pressure = wall.acceleration - c.acceleration;
      if (pressure < 1e-3 * c.peak_acceleration()) continue;
      const double hop = 3.0 * kApproachRounding * c.peak_speed() * log_uniform(random, 0.0, 3.0);
      c.distance = wall.displacement;
      c.speed = wall.velocity + hop;
      const double lasts = 2.0 * (c.speed - wall.velocity) / pressure;
      // So short that the wall's acceleration is constant. It must end before the saw-tooth jumps.
      if (c.motion.phase + lasts * c.motion.frequency >= 1.0) continue;
      const double ratio = c.contact() / lasts;
      longest = std::max(longest, ratio);
      shortest = std::min(shortest, ratio);
    }
    MESSAGE("shares of the expected time ", shortest, " .. ", longest);
    CHECK(shortest > 0.5);
    CHECK(longest < 1.5);
  }
}

// Half of the particles pass the crest slightly behind the path of the wall, and must be hit there
// or before. The others pass before it and must not be hit.
TEST_CASE("Wall motion: no grazing hit is missed or invented") {
  Verdict verdict;
  int behind = 0, met = 0, before = 0, invented = 0;
  for (std::uint32_t i = 0; i < 50000; ++i) {
    Random random(43, Stream::Velocity, i, 0);
    WallCase c = random_case(WallPath::Sinusoidal, random);
    c.start = 0.0;
    const double graze = 0.3 * random.uniform() / c.motion.frequency;
    const WallState wall = wall_state(c.motion, graze);
    c.acceleration = wall.acceleration + c.peak_acceleration() * log_uniform(random, -3.0, 1.0);
    c.speed = wall.velocity - c.acceleration * graze;
    const double shift = sign(random) * 0.5 * c.motion.stroke * log_uniform(random, -13.0, -3.0);
    c.distance = wall.displacement + shift - (c.height(graze) - c.distance);
    if (c.distance <= wall_state(c.motion, 0.0).displacement) continue;
    const double time = c.contact();
    verdict.add(c, time);
    if (shift < 0.0) {
      ++behind;
      met += time <= graze;
    } else {
      ++before;
      invented += std::fabs(time - graze) < 1e-9 / c.motion.frequency;
    }
  }
  verdict.check();
  CHECK(behind > 5000);
  CHECK(met == behind);
  CHECK(before > 5000);
  CHECK(invented == 0);
}

TEST_CASE("Wall motion: the search ends for particles that creep or rest") {
  for (const WallPath path : kPaths) {
    const WallMotion wall{path, 2.0, 0.5, 0.0};
    const double travel = innermost_travel(wall);
    for (const double speed : {0.0, 1e-30, 1e-17, -1e-30, -1e-17, -1e-10}) {
      for (const double above : {-4.0, -1.0, 0.0, 1.0, 4.0}) {
        for (const double acceleration : {0.0, -1e-25, 1e-25}) {
          const WallCase c{wall, 0.0, travel * (1.0 + above * kEpsilon), speed, acceleration};
          const double time = c.contact();
          if (time == kNever) {
            // Only for a particle that never sinks by more than a rounding error.
            CHECK((speed >= 0.0 || acceleration > 0.0));
            CHECK(acceleration >= 0.0);
          } else {
            CHECK(std::fabs(c.height(time) - travel) < 1e-9);
          }
        }
      }
    }
  }
}

TEST_CASE("Wall motion: very slow walls and very fast particles are hit in time") {
  for (const WallPath path : kPaths) {
    for (const double frequency : {1e-12, 1e-100, 1e-200}) {
      const WallMotion wall{path, 2.0, frequency, 0.0};
      CHECK(std::fabs(WallCase{wall, 0.0, 4.0, 2.0, -4.0}.contact() - 2.0) < 1e-11);
      CHECK(std::fabs(WallCase{wall, 0.0, 4.0, -2.0, 0.0}.contact() - 2.0) < 1e-11);
    }
    // They cross the range of the wall within the rounding error of the time.
    CHECK(std::fabs(WallCase{{path, 1e-3, 0.3, 0.0}, 0.0, 1e15, -1e15}.contact() - 1.0) <=
          kEpsilon);
  }
}

// These searches did not end: a period and the next one are the same double.
TEST_CASE("Wall motion: a particle that returns after 2^53 periods meets the wall farthest in") {
  struct Late {
    double stroke, frequency, height, speed, acceleration;
  };
  const Late cases[] = {
      {0.1, 100.0, 0.06, 46.7, -1e-12},           // weak gravity
      {0.1, 23.9, 35.8, -4.5e-151, 0.0},          // a cold gas
      {0.47, 43703.0, 0.48, 1.06e11, -1.03},      // a hot gas
      {3.5e-7, 8.2e-6, 3.6e-7, 3.0e26, -0.0019},  // a slow wall
      {1e-9, 1e15, 1.0, -0.01, 0.0},              // a fast one
  };
  for (const WallPath path : kPaths) {
    for (const auto& [stroke, frequency, height, speed, acceleration] : cases) {
      CAPTURE(frequency);
      const WallCase c{{path, stroke, frequency, 0.3}, 0.0, height, speed, acceleration};
      const double fall = height - (path == WallPath::Sawtooth ? stroke : 0.5 * stroke);
      // First order in the height, which is small compared with the height of the parabola.
      const double time =
          acceleration == 0.0 ? -fall / speed : -2.0 * speed / acceleration + fall / speed;
      CHECK(c.contact() == doctest::Approx(time).epsilon(1e-12));
    }
  }
}

TEST_CASE("Wall motion: scaling by powers of two changes no bit") {
  int different = 0;
  for (const WallPath path : kPaths) {
    for (const int length : {-40, 3, 40}) {
      for (const int speed : {-30, 5, 30}) {
        const double l = std::ldexp(1.0, length), s = std::ldexp(1.0, speed);
        for (std::uint32_t i = 0; i < 3000; ++i) {
          Random random(44, Stream::Velocity, i, 0);
          WallCase c = random_case(path, random), d = c;
          if (i % 3 == 0) reflect_at(c, c.start, random.uniform()), d = c;
          d.motion.stroke *= l;
          d.motion.frequency *= s / l;
          d.start *= l / s;
          d.distance *= l;
          d.speed *= s;
          d.acceleration *= s * s / l;
          different += std::bit_cast<std::uint64_t>(d.contact()) !=
                       std::bit_cast<std::uint64_t>(c.contact() * (l / s));
        }
      }
    }
  }
  CHECK(different == 0);
}

static void check_random_cases(WallPath path, std::uint32_t cases) {
  Verdict verdict;
  for (std::uint32_t i = 0; i < cases; ++i) {
    Random random(45, Stream::Velocity, i, 0);
    const WallCase c = random_case(path, random);
    verdict.add(c, c.contact());
  }
  verdict.check();
  CHECK(verdict.contacts > static_cast<int>(cases / 2));
  CHECK(verdict.never > static_cast<int>(cases / 10));
}

// Successive cases: every case but the first starts just after a hit, at a distance of rounding
// errors.
static void check_bounces(WallPath path, std::uint32_t particles) {
  Verdict verdict;
  for (std::uint32_t i = 0; i < particles; ++i) {
    Random random(46, Stream::Velocity, i, 0);
    WallCase c = random_case(path, random);
    if (random.below(2)) c.acceleration = -std::fabs(c.acceleration);
    const double restitution = random.below(8) ? random.uniform() : 0.0;
    double time = c.contact();
    verdict.add(c, time);
    for (int hits = 0; hits < 10 && time < kNever; ++hits) {
      reflect_at(c, time, restitution);
      time = c.contact();
      verdict.add(c, time);
    }
  }
  verdict.check();
}

TEST_CASE("Wall motion: no contact is missed or early in 100,000 cases, by a scan") {
  for (const WallPath path : kPaths) check_random_cases(path, 100000);
}

TEST_CASE("Wall motion: no contact is missed or early bounce after bounce, by a scan") {
  for (const WallPath path : kPaths) check_bounces(path, 10000);
}
