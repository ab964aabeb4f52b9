#include "tests/engine/support/wall_scan.h"

#include <doctest/doctest.h>

#include "engine/physics/contact.h"
#include "engine/physics/fraction.h"

namespace clatter::testing {

static constexpr double kTwoPi = 2.0 * std::numbers::pi;
static constexpr double kRoundings = 10.0;

static double displacement(const WallMotion& motion, double phase) {
  return motion.path == WallPath::Sawtooth ? motion.stroke * phase
                                           : 0.5 * motion.stroke * std::sin(kTwoPi * phase);
}

// The times after the start during which the particle is below a plane, in order. A parabola gives
// at most two intervals.
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

static Stays stays_below(const WallCase& c, double plane) {
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

// The least gap in the period from `begin`, between two times. Refines every local minimum of the
// samples that may hide a negative gap.
static double least_gap(const WallCase& c, double begin, double from, double to) {
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

// The least gap from the start until `until`, in units of the rounding error of the lengths. A
// particle that remains in the range of the wall is scanned for three periods; the wall hits it in
// the first.
static double least_gap_until(const WallCase& c, double until) {
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

static void judge_contact(Verdict& verdict, const WallCase& c, double time) {
  const double t = time - c.start;
  const WallState wall = wall_state(c.motion, time);
  double gap = std::fabs(c.height(t) - wall.displacement);
  // At the jump of the saw-tooth, rounding decides the side of a time.
  if (c.motion.path == WallPath::Sawtooth) gap = std::min(gap, std::fabs(gap - c.motion.stroke));
  verdict.residual = std::max(verdict.residual, gap / (kEpsilon * c.lengths(t)));
  verdict.recession =
      std::max(verdict.recession, (c.velocity(t) - wall.velocity) / (kEpsilon * c.speeds(t)));
}

void Verdict::add(const WallCase& c, double time) {
  if (time == c.start) {
    ++at_once;
  } else if (time == kNever) {
    ++never;
  } else {
    ++contacts;
  }
  early += time < c.start;
  if (time < kNever) judge_contact(*this, c, time);
  const double least = least_gap_until(c, time - c.start);
  overlap = std::max(overlap, -least);
  missed += least < -kRoundings;
}

void Verdict::check() const {
  MESSAGE(contacts, " contacts, ", at_once, " at once, ", never, " without; residual ", residual,
          ", overlap before ", overlap, ", recession ", recession);
  CHECK(early == 0);
  CHECK(missed == 0);
  CHECK(residual < kRoundings);
  CHECK(recession < kRoundings);
}

double sign(Random& random) {
  return random.below(2) ? 1.0 : -1.0;
}

double log_uniform(Random& random, double from, double to) {
  return std::pow(10.0, from + (to - from) * random.uniform());
}

WallCase random_case(WallPath path, Random& random) {
  WallCase c;
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

void reflect_at(WallCase& c, double time, double restitution) {
  const double t = time - c.start, wall = wall_state(c.motion, time).velocity;
  c.distance = c.height(t);
  c.speed = -restitution * c.velocity(t) + (1.0 + restitution) * wall;
  c.start = time;
}

}  // namespace clatter::testing
