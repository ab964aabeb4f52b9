#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "engine/physics/contact.h"
#include "engine/physics/fraction.h"
#include "engine/physics/random.h"
#include "engine/physics/wall_motion.h"

using namespace clatter;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// A disk before a wall: the arguments of moving_wall_contact.
struct Case {
  WallMotion motion;
  double start = 0.0;
  double distance = 0.0;
  double speed = 0.0;
  double acceleration = 0.0;

  double contact() const {
    return moving_wall_contact(motion, start, distance, speed, acceleration);
  }
  double height(double t) const { return distance + speed * t + 0.5 * acceleration * t * t; }
  double velocity(double t) const { return speed + acceleration * t; }
  double peak_speed() const {
    const double speed = motion.stroke * motion.frequency;
    return motion.path == WallPath::Sawtooth ? speed : std::numbers::pi * speed;
  }
  double peak_acceleration() const {
    return motion.path == WallPath::Sawtooth ? 0.0 : kTwoPi * motion.frequency * peak_speed();
  }
  // By how much the disk starts behind the wall: what rounding left of the flight before.
  double overlap() const {
    return std::max(0.0, wall_state(motion, start).displacement - distance);
  }
  // The speeds and lengths that occur until t after the start, on the moving base: their rounding
  // is the error.
  double speeds(double t) const {
    return std::fabs(speed) + std::fabs(acceleration * t) + peak_speed() +
           peak_acceleration() * (std::fabs(start) + t);
  }
  double lengths(double t) const {
    return std::fabs(distance) + motion.stroke +
           (std::fabs(speed) + std::fabs(acceleration * t) + peak_speed()) *
               (std::fabs(start) + t) +
           overlap() / kEpsilon;
  }
};

double sign(Random& random) {
  return random.below(2) ? 1.0 : -1.0;
}

// 10^x with x uniform.
double log_uniform(Random& random, double from, double to) {
  return std::pow(10.0, from + (to - from) * random.uniform());
}

// --- The reference: a scan of the gap over the wall's periods ---

double displacement(const WallMotion& motion, double phase) {
  return motion.path == WallPath::Sawtooth ? motion.stroke * phase
                                           : 0.5 * motion.stroke * std::sin(kTwoPi * phase);
}

// The times after the start between which the disk is lower than a plane, in order: the parabola
// gives at most two intervals.
struct Stays {
  double from[2], to[2];
  int count = 0;

  void add(double begin, double end) {
    begin = std::max(begin, 0.0);
    if (!(end > begin)) return;
    from[count] = begin;
    to[count++] = end;
  }
};

Stays stays_below(const Case& c, double plane) {
  const long double a = 0.5L * c.acceleration, b = c.speed;
  const long double above = static_cast<long double>(c.distance) - plane;
  Stays stays;
  const auto add = [&](long double begin, long double end) {
    stays.add(static_cast<double>(begin), static_cast<double>(end));
  };
  if (a == 0.0L) {
    if (b == 0.0L) {
      if (above < 0.0L) add(0.0L, kNever);
    } else {
      b < 0.0L ? add(-above / b, kNever) : add(0.0L, -above / b);
    }
    return stays;
  }
  const long double discriminant = b * b - 4.0L * a * above;
  if (discriminant <= 0.0L) {
    if (a < 0.0L) add(0.0L, kNever);
    return stays;
  }
  const long double q = -0.5L * (b + std::copysign(std::sqrt(discriminant), b));
  const long double one = q / a, other = q != 0.0L ? above / q : 0.0L;
  const long double first = std::min(one, other), last = std::max(one, other);
  if (a > 0.0L) {
    add(first, last);
  } else {
    add(0.0L, first);
    add(last, kNever);
  }
  return stays;
}

// The least gap in a period that begins at `begin`, from a time to another: every local minimum of
// samples that may hide a negative one is narrowed in.
double least_gap(const Case& c, double begin, double from, double to) {
  const auto gap = [&](double t) {
    const double phase = std::clamp((t - begin) * c.motion.frequency, 0.0, 1.0);
    return c.height(t) - displacement(c.motion, phase);
  };
  constexpr int samples = 150;
  const double step = (to - from) / samples;
  const double hidden = (std::fabs(c.acceleration) + c.peak_acceleration()) * step * step;
  double least = gap(from), before = least, here = least;
  for (int i = 1; i <= samples; ++i) {
    const double after = gap(i < samples ? from + step * i : to);
    least = std::min(least, after);
    if (here <= before && here <= after && here < hidden) {
      double left = from + step * std::max(i - 2, 0), right = from + step * i;
      for (int k = 0; k < 60; ++k) {
        const double third = (right - left) / 3.0;
        gap(left + third) < gap(right - third) ? right -= third : left += third;
      }
      least = std::min(least, gap(left));
    }
    before = here;
    here = after;
  }
  return least;
}

// The least gap from the start until `until`, in units of the lengths' rounding. A disk that stays
// where the wall goes is scanned for three periods: it is met in the first.
double least_gap_until(const Case& c, double until) {
  const double f = c.motion.frequency, phase = fraction(c.motion.phase + f * c.start);
  const Stays stays = stays_below(c, innermost_travel(c.motion));
  double least = kNever;
  for (int i = 0; i < stays.count; ++i) {
    double from = stays.from[i];
    const double to = std::min({stays.to[i], from + 3.0 / f, until});
    for (double n = std::floor(phase + f * from); from < to; ++n) {
      const double end = std::min((n + 1.0 - phase) / f, to);
      if (!(end > from)) continue;
      least = std::min(least, least_gap(c, (n - phase) / f, from, end) / c.lengths(end));
      from = end;
    }
  }
  return least / kEpsilon;
}

// What contact times left to be desired, over many cases; worst values in units of the rounding.
struct Verdict {
  int contacts = 0, at_once = 0, never = 0, early = 0, missed = 0;
  double residual = 0.0, overlap = 0.0, recession = 0.0;

  void add(const Case& c, double time) {
    if (time == c.start) {
      ++at_once;
    } else if (time == kNever) {
      ++never;
    } else {
      ++contacts;
    }
    early += time < c.start;
    if (time < kNever) judge_contact(c, time);
    const double least = least_gap_until(c, time - c.start);
    overlap = std::max(overlap, -least);
    missed += least < -kRoundings;
  }

  void judge_contact(const Case& c, double time) {
    const double t = time - c.start;
    const WallState wall = wall_state(c.motion, time);
    double gap = std::fabs(c.height(t) - wall.displacement);
    // At the saw-tooth's jump rounding decides on which side the time lies.
    if (c.motion.path == WallPath::Sawtooth) gap = std::min(gap, std::fabs(gap - c.motion.stroke));
    residual = std::max(residual, gap / (kEpsilon * c.lengths(t)));
    recession = std::max(recession, (c.velocity(t) - wall.velocity) / (kEpsilon * c.speeds(t)));
  }

  void check() const {
    MESSAGE(contacts, " contacts, ", at_once, " at once, ", never, " without; residual ", residual,
            ", overlap before ", overlap, ", recession ", recession);
    CHECK(early == 0);
    CHECK(missed == 0);
    CHECK(residual < kRoundings);
    CHECK(recession < kRoundings);
  }

  static constexpr double kRoundings = 10.0;
};

// A disk before a wall, over wide ranges of what the wall's stroke and frequency leave free.
Case random_case(WallPath path, Random& random) {
  Case c;
  const double stroke = log_uniform(random, -3.0, 3.0), frequency = log_uniform(random, -3.0, 3.0);
  c.motion = {path, stroke, frequency, random.uniform()};
  if (random.below(8) == 0) {
    c.motion.phase = fraction(0.25 * static_cast<double>(random.below(4)) +
                              sign(random) * log_uniform(random, -17.0, -6.0));
  }
  if (random.below(4)) c.start = sign(random) * log_uniform(random, -6.0, 3.0) / frequency;
  c.distance =
      wall_state(c.motion, c.start).displacement + stroke * log_uniform(random, -15.0, 1.0);
  c.speed = sign(random) * stroke * frequency * log_uniform(random, -4.0, 4.0);
  if (random.below(3)) {
    c.acceleration = sign(random) * stroke * frequency * frequency * log_uniform(random, -3.0, 4.0);
  }
  return c;
}

// The disk after the wall has hit it, section 3.
void reflect_at(Case& c, double time, double restitution) {
  const double t = time - c.start, wall = wall_state(c.motion, time).velocity;
  c.distance = c.height(t);
  c.speed = -restitution * c.velocity(t) + (1.0 + restitution) * wall;
  c.start = time;
}

constexpr WallPath kPaths[] = {WallPath::Sawtooth, WallPath::Sinusoidal};

}  // namespace

TEST_CASE("wall motion: where the wall is") {
  const WallMotion sawtooth{WallPath::Sawtooth, 3.0, 0.5, 0.25};
  CHECK(innermost_travel(sawtooth) == 3.0);
  for (const double time : {0.0, 2.0, -2.0, 2e6}) {
    const WallState wall = wall_state(sawtooth, time + 0.5);
    CHECK(wall.displacement == 1.5);
    CHECK(wall.velocity == 1.5);
    CHECK(wall.acceleration == 0.0);
    CHECK(wall_state(sawtooth, time + 1.5).displacement == 0.0);
  }
  // The rounding of a time just before the jump puts it after.
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

TEST_CASE("wall motion: a wall at rest is a plane") {
  for (const WallPath path : kPaths) {
    for (const WallMotion motion : {WallMotion{path, 0.0, 3.0, 0.25}, {path, 2.0, 0.0, 0.25}}) {
      const WallState wall = wall_state(motion, 7.0);
      CHECK(wall.velocity == 0.0);
      const double place = wall.displacement;
      CHECK(Case{motion, 7.0, place + 3.0, -2.0, 0.0}.contact() == 8.5);
      CHECK(Case{motion, 7.0, place + 3.0, 2.0, 0.0}.contact() == kNever);
      CHECK(Case{motion, 7.0, place + 3.0, 2.0, -2.0}.contact() == 10.0);
      CHECK(Case{motion, 7.0, place, -1e-300, 0.0}.contact() == 7.0);
      CHECK(Case{motion, 7.0, place, 0.0, 0.0}.contact() == kNever);
      CHECK(Case{motion, 7.0, place, 0.0, -1.0}.contact() == 7.0);
      CHECK(Case{motion, 7.0, place, 1.0, -1.0}.contact() == 9.0);
    }
  }
}

TEST_CASE("wall motion: hits by a saw-tooth") {
  const WallMotion wall{WallPath::Sawtooth, 2.0, 0.5, 0.0};  // of speed 1 and period 2
  CHECK(Case{wall, 0.0, 1.0, 0.0}.contact() == 1.0);
  CHECK(Case{wall, 0.0, 3.0, -1.0}.contact() == 1.5);
  CHECK(Case{wall, -4.0, 3.0, -1.0}.contact() == -2.5);
  CHECK(Case{wall, 0.0, 5.0, -1.0}.contact() == 3.5);
  CHECK(Case{wall, 2e6, 5.0, -1.0}.contact() == 2e6 + 3.5);
  CHECK(Case{wall, 0.0, 0.5, 0.5}.contact() == 1.0);     // chased
  CHECK(Case{wall, 0.0, 1.5, 0.5}.contact() == kNever);  // It leaves before the wall arrives.
  CHECK(Case{wall, 0.0, 2.0, 0.0}.contact() == kNever);  // out of reach
  CHECK(Case{wall, 1.0, 1.5, 0.1875, 0.0}.contact() == 1.0 + 0.5 / 0.8125);
  // Thrown out of the zone and back: 1 + 4t - t^2 = t - 2 on the second ramp.
  CHECK(Case{wall, 0.0, 1.0, 4.0, -2.0}.contact() == (3.0 + std::sqrt(21.0)) / 2.0);
}

TEST_CASE("wall motion: hits by a sinusoidal wall") {
  const WallMotion wall{WallPath::Sinusoidal, 2.0, 0.25, 0.0};  // of amplitude 1 and period 4
  const auto check = [&](double start, double distance, double speed, double acceleration,
                         double expected) {
    const double time = Case{wall, start, distance, speed, acceleration}.contact();
    CHECK(std::fabs(time - expected) < 4e-15);
  };
  check(0.0, 0.5, 0.0, 0.0, 1.0 / 3.0);
  check(-6.0, 0.5, 0.0, 0.0, -4.0 + 1.0 / 3.0);
  check(0.0, 2.0, -1.0, 0.0, 1.0);                       // at the crest
  check(0.0, 5.0, -2.0, 0.0, 3.0);                       // at the trough
  check(0.0, 0.25, 0.75, 0.0, 1.0 / 3.0);                // chased
  check(2.0, 0.5 - 7.0 / 24.0, 0.125, 0.0, 13.0 / 3.0);  // chased in the next period
  check(0.0, 6.0, 6.0, -2.0, 7.0);                       // thrown out of the zone and back
  CHECK(Case{wall, 0.0, 0.5, 2.0}.contact() == kNever);
  CHECK(Case{wall, 0.0, 1.0 + 1e-15, 0.0}.contact() == kNever);  // out of reach
  CHECK(Case{wall, 1.5, 0.75, 0.5}.contact() == kNever);         // leaves before the wall returns
  CHECK(Case{wall, 0.0, 10.0, -4.0, 1.0}.contact() == kNever);   // turns before the zone
}

TEST_CASE("wall motion: disks that touch the wall") {
  const WallMotion ramps{WallPath::Sawtooth, 2.0, 0.5, 0.0};
  for (const double overlap : {0.0, 1e-15}) {
    const auto contact = [&](double speed, double acceleration) {
      return Case{ramps, 1.0, 1.0 - overlap, speed, acceleration}.contact();
    };
    CHECK(contact(0.0, 0.0) == 1.0);
    CHECK(contact(0.0, 8.0) == 1.0);
    CHECK(contact(1.0 - 1e-14, 0.0) == 1.0);
    CHECK(contact(1.0, -1e-9) == 1.0);  // It rides the wall, pressed.
    CHECK(contact(1.0, 0.0) == kNever);
    CHECK(contact(1.0 - 1e-15, 0.0) == kNever);
    CHECK(contact(1.0 - 1e-15, 8.0) == kNever);
    CHECK(contact(2.0, 0.0) == kNever);
    CHECK(contact(2.0, -1.0) == 5.0);  // t - t^2/2 = -4 on the third ramp
  }
  // It rides along until the wall turns its acceleration, at phase 1/2, and is hit after that.
  const WallMotion wave{WallPath::Sinusoidal, 2.0, 0.25, 0.0};
  const auto ride = [&](double start) {
    const WallState wall = wall_state(wave, start);
    return Case{wave, start, wall.displacement, wall.velocity}.contact();
  };
  CHECK(ride(1.5) > 2.0);
  CHECK(ride(1.5) < 4.0);
  CHECK(ride(2.5) == 2.5);
}

// A wholly inelastic hit and what follows: rounding of either sign, of the wall's phase too.
TEST_CASE("wall motion: a disk that rides the wall, but for rounding") {
  for (const WallPath path : kPaths) {
    Verdict verdict;
    for (std::uint32_t i = 0; i < 10000; ++i) {
      Random random(41, Stream::Velocity, i, 0);
      Case c = random_case(path, random);
      const WallState wall = wall_state(c.motion, c.start);
      c.distance = wall.displacement * (1.0 - kEpsilon * static_cast<double>(random.below(3)));
      c.speed = wall.velocity * (1.0 + kEpsilon * (random.uniform() - 0.5));
      verdict.add(c, c.contact());
    }
    verdict.check();
    CHECK(verdict.at_once > 1000);
  }
}

// One hop of a disk that leaves the wall at hardly more than the rounding of the speeds, while the
// accelerations press it back: it lasts 2 speed / acceleration, not nothing.
TEST_CASE("wall motion: the smallest hops come to their end, and not before") {
  for (const WallPath path : kPaths) {
    double longest = 0.0, shortest = kNever;
    for (std::uint32_t i = 0; i < 100000; ++i) {
      Random random(42, Stream::Velocity, i, 0);
      Case c = random_case(path, random);
      c.start = 0.0;
      const WallState wall = wall_state(c.motion, 0.0);
      c.acceleration = -std::fabs(c.acceleration) - 0.1 * c.peak_speed() * c.motion.frequency;
      const double pressure = wall.acceleration - c.acceleration;
      if (pressure < 1e-3 * c.peak_acceleration()) continue;
      const double hop = 3.0 * kApproachRounding * c.peak_speed() * log_uniform(random, 0.0, 3.0);
      c.distance = wall.displacement;
      c.speed = wall.velocity + hop;
      const double lasts = 2.0 * (c.speed - wall.velocity) / pressure;
      // Too short for the wall's acceleration to change; it must end before the saw-tooth jumps.
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

// Half of the disks pass the crest's neighbourhood behind the wall's path by a little, and must be
// hit there or before; the others pass before it and must not.
TEST_CASE("wall motion: grazing passes") {
  Verdict verdict;
  int behind = 0, met = 0, before = 0, invented = 0;
  for (std::uint32_t i = 0; i < 50000; ++i) {
    Random random(43, Stream::Velocity, i, 0);
    Case c = random_case(WallPath::Sinusoidal, random);
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

TEST_CASE("wall motion: a disk that creeps, or rests but for rounding, ends the search") {
  for (const WallPath path : kPaths) {
    const WallMotion wall{path, 2.0, 0.5, 0.0};
    const double travel = innermost_travel(wall);
    for (const double speed : {0.0, 1e-30, 1e-17, -1e-30, -1e-17, -1e-10}) {
      for (const double above : {-4.0, -1.0, 0.0, 1.0, 4.0}) {
        for (const double acceleration : {0.0, -1e-25, 1e-25}) {
          const Case c{wall, 0.0, travel * (1.0 + above * kEpsilon), speed, acceleration};
          const double time = c.contact();
          if (time == kNever) {
            // Only a disk that never sinks by more than rounding.
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

TEST_CASE("wall motion: walls so slow or disks so fast that the other seems to stand") {
  for (const WallPath path : kPaths) {
    for (const double frequency : {1e-12, 1e-100, 1e-200}) {
      const WallMotion wall{path, 2.0, frequency, 0.0};
      CHECK(std::fabs(Case{wall, 0.0, 4.0, 2.0, -4.0}.contact() - 2.0) < 1e-11);
      CHECK(std::fabs(Case{wall, 0.0, 4.0, -2.0, 0.0}.contact() - 2.0) < 1e-11);
    }
    // They cross the wall's way within the rounding of the time.
    CHECK(std::fabs(Case{{path, 1e-3, 0.3, 0.0}, 0.0, 1e15, -1e15}.contact() - 1.0) <= kEpsilon);
  }
}

TEST_CASE("wall motion: powers of two scale lengths and velocities without a bit's change") {
  int different = 0;
  for (const WallPath path : kPaths) {
    for (const int length : {-40, 3, 40}) {
      for (const int speed : {-30, 5, 30}) {
        const double l = std::ldexp(1.0, length), s = std::ldexp(1.0, speed);
        for (std::uint32_t i = 0; i < 3000; ++i) {
          Random random(44, Stream::Velocity, i, 0);
          Case c = random_case(path, random), d = c;
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
    const Case c = random_case(path, random);
    verdict.add(c, c.contact());
  }
  verdict.check();
  CHECK(verdict.contacts > static_cast<int>(cases / 2));
  CHECK(verdict.never > static_cast<int>(cases / 10));
}

// Cases that follow from each other: every one but the first starts just after a hit, as far from
// the wall as rounding leaves it.
static void check_bounces(WallPath path, std::uint32_t disks) {
  Verdict verdict;
  for (std::uint32_t i = 0; i < disks; ++i) {
    Random random(46, Stream::Velocity, i, 0);
    Case c = random_case(path, random);
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

TEST_CASE("wall motion: the first contact of 100,000 cases, against a scan") {
  for (const WallPath path : kPaths) check_random_cases(path, 100000);
}

TEST_CASE("wall motion: bounce after bounce, against a scan") {
  for (const WallPath path : kPaths) check_bounces(path, 10000);
}
