#include "engine/physics/wall_motion.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "engine/physics/contact.h"
#include "engine/physics/elementary.h"
#include "engine/physics/fall_time.h"
#include "engine/physics/fraction.h"

namespace clatter {

namespace {

constexpr double kRadiansPerPeriod = 2.0 * std::numbers::pi;

double wall_velocity(const WallMotion& motion, double phase) {
  if (motion.path == WallPath::Sawtooth) return motion.stroke * motion.frequency;
  return 0.5 * motion.stroke * (kRadiansPerPeriod * motion.frequency) * cos_2pi(phase);
}

// The amplitude of the sinusoidal wall's acceleration.
double peak_acceleration(const WallMotion& motion) {
  const double angular_frequency = kRadiansPerPeriod * motion.frequency;
  return 0.5 * motion.stroke * angular_frequency * angular_frequency;
}

// A particle that approaches a moving wall, as functions of the time t since the start. "Crests"
// are the times at which the wall is innermost; for the saw-tooth these are the ends of its ramps.
struct Approach {
  WallMotion motion;    // with the phase at t = 0
  double gap;           // between particle and wall at t = 0, >= 0
  double height;        // of the particle above the wall's rest position at t = 0
  double speed;         // of the particle at t = 0, inwards
  double acceleration;  // of the particle, inwards

  double velocity(double t) const { return speed + acceleration * t; }
  double rise(double t) const { return speed * t + 0.5 * acceleration * t * t; }

  // Time at which the particle reaches a plane; 0 if it is already beyond.
  double time_to(double plane) const {
    return height < plane ? 0.0 : fall_time(height - plane, speed, acceleration);
  }
};

// A gap is the gap at t = 0 plus the changes since. Its error is the error of the speeds times t.
// Just after a hit even a very small gap thus has the relative precision of the velocities.

// The gap to ramp `number` of the saw-tooth; ramp 0 contains t = 0. All ramps are the same line,
// each shifted back by one stroke.
double gap_to_ramp(const Approach& particle, double number, double t) {
  const double ramp_rise = particle.motion.stroke * particle.motion.frequency * t;
  return particle.gap + (particle.rise(t) - (ramp_rise - number * particle.motion.stroke));
}

// The gap to the sinusoidal wall, from sin(x + 2y) - sin(x) = 2 cos(x + y) sin(y).
double gap_to_wave(const Approach& particle, double t) {
  const double half = fraction(0.5 * particle.motion.frequency * t);
  const double wave_rise =
      particle.motion.stroke * cos_2pi(particle.motion.phase + half) * sin_2pi(half);
  return particle.gap + (particle.rise(t) - wave_rise);
}

double gap_rate(const Approach& particle, double t) {
  return particle.velocity(t) -
         wall_velocity(particle.motion, particle.motion.phase + particle.motion.frequency * t);
}

// Newton's method starts on the side of the root where gap and curvature have the same sign. On a
// convex or concave gap it then never passes the root, because the tangent reaches zero first. Each
// step divides gap * rate by at least four, even for grazing contacts: by convexity the factors of
// gap and rate have a sum of at most one. Both searches end when the gap changes its sign or the
// step is lost in rounding. kMaxSteps steps suffice for this.
constexpr int kMaxSteps = 200;

// The first root of a gap that is convex and not negative at `left`; the search starts at `left`.
double convex_contact(const Approach& particle, double left, double right) {
  double t = left;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double rate = gap_rate(particle, t);
    if (rate >= 0.0) return kNever;
    const double gap = gap_to_wave(particle, t);
    const double next = t - gap / rate;
    if (!(next > t)) return t;
    if (next > right) return kNever;
    t = next;
  }
  return t;
}

// The root of a gap that is concave and not negative at `left`. It exists if the gap is negative at
// `right`; the search starts at `right`.
double concave_contact(const Approach& particle, double left, double right) {
  double t = right;
  double gap = gap_to_wave(particle, t);
  if (gap >= 0.0) return kNever;
  for (int step = 0; gap < 0.0 && step < kMaxSteps; ++step) {
    const double next = t - gap / gap_rate(particle, t);
    if (!(next < t)) return t;
    if (next <= left) return left;
    t = next;
    gap = gap_to_wave(particle, t);
  }
  return t;
}

// The first contact with the sinusoidal wall between t and the next crest. The gap's curvature,
// acceleration + peak_acceleration sin(2 pi phase), is positive near the crests and negative
// between them, or has one sign always. So there are at most three pieces.
double contact_with_wave(const Approach& particle, double t, double crest) {
  const double lowest = particle.time_to(-1.5 * particle.motion.stroke);  // A hit is earlier.
  const double cosine =
      std::clamp(-particle.acceleration / peak_acceleration(particle.motion), -1.0, 1.0);
  const double period = 1.0 / particle.motion.frequency;
  const double convex_time = acos_turns(cosine) * period;
  bool convex = true;
  for (const double end : {crest - (period - convex_time), crest - convex_time, crest}) {
    const double right = std::min(end, lowest);
    if (right > t) {
      const double contact =
          convex ? convex_contact(particle, t, right) : concave_contact(particle, t, right);
      if (contact < kNever) return contact;
      t = right;
    }
    convex = !convex;
  }
  return t < lowest ? kNever : lowest;
}

// The contact with a ramp of the saw-tooth or its extended line; a parabola has at most one.
double contact_with_ramp(const Approach& particle, double number) {
  return fall_time(particle.gap + number * particle.motion.stroke, gap_rate(particle, 0.0),
                   particle.acceleration);
}

// The search begins when the particle comes near the range of the wall, and proceeds from crest to
// crest. A particle behind the wall at a crest has been hit. A particle in front of the wall at a
// crest can be hit only after it has fallen to the crest's height; the search continues there. A
// particle that stays below this height for a period is hit. A parabola falls to a height at most
// twice, so the search visits few crests.
//
// "Near" means one stroke from the wall's extreme positions: the rounding of the initial height
// must not affect particles that touch the wall there.
//
// The search ends for every input. Times after kMaxPeriods periods are too coarse to resolve a
// period, and the wall passes its innermost position between any two of them. The contact then is
// the particle's arrival at this position. Before that time, each crest is later than the previous
// one. A particle still in front after kMaxCrests crests has fallen to their height each time, and
// only rounding keeps it there.
double contact_with_moving(const Approach& particle) {
  constexpr double kMaxPeriods = 0x1p51;
  constexpr int kMaxCrests = 1000;
  const WallMotion& motion = particle.motion;
  const bool ramps = motion.path == WallPath::Sawtooth;
  // Periods from t = 0 to the first crest, in (0,1].
  const double lead = 1.0 - (ramps ? motion.phase : fraction(motion.phase - 0.25));
  const double innermost = innermost_travel(motion);
  double t = particle.time_to(innermost + motion.stroke);
  if (!(motion.frequency * t < kMaxPeriods)) return particle.time_to(innermost);
  double number = 0.0;
  for (int crests = 0; crests < kMaxCrests && motion.frequency * t < kMaxPeriods; ++crests) {
    number = std::max(number, std::ceil(motion.frequency * t - lead));
    const double crest = (number + lead) / motion.frequency;
    const double contact =
        ramps ? contact_with_ramp(particle, number) : contact_with_wave(particle, t, crest);
    if (contact < crest) return contact;
    const double gap = ramps ? gap_to_ramp(particle, number, crest) : gap_to_wave(particle, crest);
    t = crest + fall_time(gap, particle.velocity(crest), particle.acceleration);
    if (t == crest) return crest;
    ++number;
  }
  return t;
}

}  // namespace

WallState wall_state(const WallMotion& motion, double time) {
  const double phase = fraction(motion.frequency * time + motion.phase);
  const double velocity = wall_velocity(motion, phase);
  if (motion.path == WallPath::Sawtooth) return {motion.stroke * phase, velocity, 0.0};
  const double sine = sin_2pi(phase);
  return {0.5 * motion.stroke * sine, velocity, -peak_acceleration(motion) * sine};
}

double innermost_travel(const WallMotion& motion) {
  return motion.path == WallPath::Sawtooth ? motion.stroke : 0.5 * motion.stroke;
}

double moving_wall_contact(const WallMotion& motion, double start, double distance, double speed,
                           double acceleration, double rest_velocity) {
  const WallState wall = wall_state(motion, start);
  const double wall_velocity = wall.velocity + rest_velocity;
  const bool touching = distance <= wall.displacement;
  if (touching) {
    const double recession = speed - wall_velocity;
    const double rounding = kApproachRounding * (std::fabs(speed) + std::fabs(wall_velocity));
    const bool pressed = acceleration < wall.acceleration;
    if (recession < -rounding || (recession <= rounding && pressed)) return start;
    // The remaining overlap and approach are rounding; remove them.
    distance = wall.displacement;
    speed = std::max(speed, wall_velocity);
  }
  speed -= rest_velocity;
  Approach particle{motion, distance - wall.displacement, distance, speed, acceleration};
  particle.motion.phase = fraction(motion.frequency * start + motion.phase);
  const bool at_rest = motion.stroke * motion.frequency == 0.0;
  const double contact = start + (at_rest ? fall_time(particle.gap, speed, acceleration)
                                          : contact_with_moving(particle));
  // A particle that recedes has its next contact later, at least by the smallest time step.
  return touching && contact == start
             ? std::nextafter(start, std::numeric_limits<double>::infinity())
             : contact;
}

}  // namespace clatter
