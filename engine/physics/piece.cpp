#include "engine/physics/piece.h"

#include <algorithm>
#include <cmath>

#include "engine/physics/contact.h"

namespace clatter {

template <int D>
Vec<D> Piece<D>::foot(const Vec<D>& position) const {
  Vec<D> foot = corner;
  for (int k = 0; k < rank; ++k) {
    foot += std::clamp(directions[k].dot(position - corner), 0.0, lengths[k]) * directions[k];
  }
  return foot;
}

template <int D>
double Piece<D>::distance(const Vec<D>& position) const {
  return (position - foot(position)).norm() - radius;
}

template <int D>
bool Piece<D>::operator==(const Piece& other) const {
  bool same = corner == other.corner && rank == other.rank && radius == other.radius;
  for (int k = 0; same && k < rank; ++k) {
    same = directions[k] == other.directions[k] && lengths[k] == other.lengths[k];
  }
  return same;
}

template <int D>
Vec<D> Piece<D>::normal_at(const Vec<D>& position) const {
  if (is_plate()) return normal.dot(position - corner) < 0.0 ? Vec<D>(-normal) : normal;
  return (position - foot(position)).normalized();
}

template <int D>
std::pair<Vec<D>, Vec<D>> Piece<D>::bounds() const {
  Vec<D> low = corner, high = corner;
  for (int k = 0; k < rank; ++k) {
    const Vec<D> edge = lengths[k] * directions[k];
    low += edge.cwiseMin(0.0);
    high += edge.cwiseMax(0.0);
  }
  return {low - Vec<D>::Constant(radius), high + Vec<D>::Constant(radius)};
}

template <int D>
Piece<D> ball_piece(const Vec<D>& centre, double radius) {
  Piece<D> ball;
  ball.directions.fill(Vec<D>::Zero());
  ball.corner = centre;
  ball.radius = radius;
  return ball;
}

template <int D>
Piece<D> flat_piece(const Vec<D>& corner, const std::vector<Vec<D>>& edges) {
  Piece<D> piece;
  piece.directions.fill(Vec<D>::Zero());
  piece.corner = corner;
  piece.rank = static_cast<int>(edges.size());
  for (std::size_t k = 0; k < edges.size(); ++k) {
    piece.lengths[k] = edges[k].norm();
    piece.directions[k] = edges[k] / piece.lengths[k];
  }
  if (!piece.is_plate()) return piece;
  if constexpr (D == 2) {
    piece.normal = Vec<D>(-piece.directions[0][1], piece.directions[0][0]);
  } else {
    piece.normal = piece.directions[0].cross(piece.directions[1]);
  }
  return piece;
}

// The time at which a function becomes 0 or less, between a time at which it is above 0 and a later
// one. The result is the last time before.
template <class Function>
static double zero_between(const Function& function, double before, double after) {
  while (true) {
    const double middle = before + 0.5 * (after - before);
    if (!(middle > before && middle < after)) return before;
    (function(middle) > 0.0 ? before : after) = middle;
  }
}

// Times at which a function changes its sign are between its stationary points. So the turning
// points of the derivative bracket those of the distance, and these bracket the contacts. A closed
// formula of the quartic would lose digits where grazing is decided.
template <int D>
FallTimes fall_times(const Vec<D>& x, const Vec<D>& v, const Vec<D>& g, double distance) {
  const double c1 = x.dot(v), c2 = v.squaredNorm() + x.dot(g), c3 = v.dot(g), c4 = g.squaredNorm();
  // The squared distance minus that of contact, and half its derivative.
  const auto gap = [&](double t) {
    return (x + (v + g * (0.5 * t)) * t).squaredNorm() - distance * distance;
  };
  const auto slope = [&](double t) { return c1 + (c2 + (1.5 * c3 + 0.5 * c4 * t) * t) * t; };
  // Ends of the intervals in which the slope is monotonic.
  std::array<double, 4> ends = {};
  int count = 1;
  const double root = 9.0 * c3 * c3 - 6.0 * c2 * c4;  // (3 c3)^2 - 4 (3/2 c4) c2
  double last = 0.0;
  if (root > 0.0) {
    const double q = -0.5 * (3.0 * c3 + (c3 < 0.0 ? -std::sqrt(root) : std::sqrt(root)));
    const auto [low, high] = std::minmax({q / (1.5 * c4), q == 0.0 ? 0.0 : c2 / q});
    for (const double t : {low, high}) {
      if (t > 0.0) ends[count++] = last = t;
    }
  }
  double far = std::max(1.0, 2.0 * last);
  while (!(slope(far) > 0.0) && far < kNever) far *= 2.0;
  ends[count++] = far;
  // Times at which the distance is stationary, and the two ends.
  std::array<double, 5> turns = {};
  int turn_count = 1;
  for (int k = 0; k + 1 < count; ++k) {
    const double from = slope(ends[k]), to = slope(ends[k + 1]);
    if (from > 0.0 && !(to > 0.0)) {
      turns[turn_count++] = zero_between(slope, ends[k], ends[k + 1]);
    } else if (!(from > 0.0) && to > 0.0) {
      turns[turn_count++] = zero_between([&](double t) { return -slope(t); }, ends[k], ends[k + 1]);
    }
  }
  turns[turn_count++] = far;

  FallTimes falls;
  const auto add = [&](double t) { falls.times[falls.count++] = t; };
  // Of a particle that touches from the start, until it is clearly away.
  bool touches = !(gap(0.0) > 0.0);
  const double rounding = kApproachRounding * distance * v.norm();
  for (int k = 0; k + 1 < turn_count && falls.count < 2; ++k) {
    const double from = gap(turns[k]), to = gap(turns[k + 1]);
    if (from > 0.0) touches = false;
    const bool falls_here = slope(0.5 * (turns[k] + turns[k + 1])) < 0.0;
    if (!falls_here) continue;
    if (from > 0.0 && !(to > 0.0)) {
      add(zero_between(gap, turns[k], turns[k + 1]));
    } else if (touches && (k > 0 || c1 < -rounding || c2 < 0.0)) {
      add(turns[k]);
      touches = false;
    }
  }
  return falls;
}

// Whether the foot of a position relative to the corner is on a piece. `rounding` is that of the
// position: at a seam one of two plates answers at least.
template <int D>
static bool has_foot(const Piece<D>& piece, const Vec<D>& place, double rounding) {
  for (int k = 0; k < piece.rank; ++k) {
    const double along = piece.directions[k].dot(place);
    if (!(along >= -rounding && along <= piece.lengths[k] + rounding)) return false;
  }
  return true;
}

// The time at which a particle reaches one face of a plate and its foot is on the plate. `side` is
// +1 or -1. A particle that is farther behind the face than by rounding may be beside the plate:
// it first rises through the plane and then falls back.
template <int D>
static double face_contact_time(const Piece<D>& plate, const Vec<D>& x, const Vec<D>& v,
                                const Vec<D>& g, double side, double distance, double rounding) {
  constexpr double kSlit = 1e-9;  // of the distance
  const double gap = side * plate.normal.dot(x) - distance;
  double speed = side * plate.normal.dot(v);
  const double acceleration = side * plate.normal.dot(g);
  const bool behind = gap < -std::max(kSlit * distance, rounding);
  if (behind && !(speed > 0.0 && acceleration < 0.0)) return kNever;
  if (gap <= 0.0 && std::fabs(speed) <= kApproachRounding * v.norm()) speed = 0.0;
  double time;
  if (behind) {
    const double discriminant = speed * speed - 2.0 * acceleration * gap;
    if (!(discriminant > 0.0)) return kNever;
    time = (speed + std::sqrt(discriminant)) / -acceleration;
  } else {
    time = fall_time(gap, speed, acceleration);
  }
  if (time == kNever) return kNever;
  return has_foot<D>(plate, x + (v + g * (0.5 * time)) * time, rounding) ? time : kNever;
}

template <int D>
double piece_contact_time(const Piece<D>& piece, const Flight<D>& flight, const Vec<D>& shift,
                          double radius, const Vec<D>& gravity) {
  const Vec<D> start = (flight.r + shift) - piece.corner;
  const double distance = piece.radius + radius;
  const double rounding = kApproachRounding * (flight.r.norm() + piece.corner.norm());
  if (piece.is_plate()) {
    const auto after = [&](double side) {
      return face_contact_time<D>(piece, start, flight.v, gravity, side, distance, rounding);
    };
    return flight.time + std::min(after(1.0), after(-1.0));
  }
  // The parts of all vectors across the edges.
  Vec<D> x = start, v = flight.v, g = gravity;
  for (int k = 0; k < piece.rank; ++k) {
    for (Vec<D>* vector : {&x, &v, &g}) {
      *vector -= piece.directions[k].dot(*vector) * piece.directions[k];
    }
  }
  const auto on_piece = [&](double time) {
    return has_foot<D>(piece, start + (flight.v + gravity * (0.5 * time)) * time, rounding);
  };
  if ((g.array() != 0.0).any()) {
    const FallTimes falls = fall_times<D>(x, v, g, distance);
    for (int k = 0; k < falls.count; ++k) {
      if (on_piece(falls.times[k])) return flight.time + falls.times[k];
    }
    return kNever;
  }
  const Flight<D> across{x, v, 0.0, 0}, rest{};
  const double time = contact_time<D>(across, rest, Vec<D>::Zero(), distance, g);
  return time != kNever && on_piece(time) ? flight.time + time : kNever;
}

template <int D>
double crossing_time(const Piece<D>& plate, const Flight<D>& flight, const Vec<D>& shift,
                     const Vec<D>& gravity) {
  const Vec<D> start = (flight.r + shift) - plate.corner;
  const double rounding = kApproachRounding * (flight.r.norm() + plate.corner.norm());
  double height = plate.normal.dot(start);
  if (std::fabs(height) <= rounding) height = 0.0;
  const double speed = plate.normal.dot(flight.v), half = 0.5 * plate.normal.dot(gravity);
  // Roots of height + speed t + half t^2, by the form that adds numbers of one sign.
  std::array<double, 2> times = {kNever, kNever};
  if (half == 0.0) {
    times[0] = -height / speed;
  } else if (height == 0.0) {
    times[0] = -speed / half;
  } else if (const double root = speed * speed - 4.0 * half * height; root > 0.0) {
    const double sum = -0.5 * (speed + std::copysign(std::sqrt(root), speed));
    times = {sum / half, height / sum};
    if (times[1] < times[0]) std::swap(times[0], times[1]);
  }
  for (const double time : times) {
    if (!(time > 0.0 && time < kNever)) continue;
    const Vec<D> place = start + (flight.v + gravity * (0.5 * time)) * time;
    if (has_foot<D>(plate, place, rounding)) return flight.time + time;
  }
  return kNever;
}

template struct Piece<2>;
template struct Piece<3>;
template Piece<2> ball_piece(const Vec<2>&, double);
template Piece<3> ball_piece(const Vec<3>&, double);
template Piece<2> flat_piece(const Vec<2>&, const std::vector<Vec<2>>&);
template Piece<3> flat_piece(const Vec<3>&, const std::vector<Vec<3>>&);
template FallTimes fall_times<2>(const Vec<2>&, const Vec<2>&, const Vec<2>&, double);
template FallTimes fall_times<3>(const Vec<3>&, const Vec<3>&, const Vec<3>&, double);
template double piece_contact_time(const Piece<2>&, const Flight<2>&, const Vec<2>&, double,
                                   const Vec<2>&);
template double piece_contact_time(const Piece<3>&, const Flight<3>&, const Vec<3>&, double,
                                   const Vec<3>&);

template double crossing_time(const Piece<2>&, const Flight<2>&, const Vec<2>&, const Vec<2>&);
template double crossing_time(const Piece<3>&, const Flight<3>&, const Vec<3>&, const Vec<3>&);

}  // namespace clatter
