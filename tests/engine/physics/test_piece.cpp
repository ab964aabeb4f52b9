#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/physics/pair_contact.h"
#include "engine/physics/piece.h"
#include "engine/physics/random.h"
#include "tests/support/dimensions.h"

namespace clatter::pieces {

using namespace testing;

namespace {

// A body by its distance alone: all points within `radius` of a box of any rank, whose edges are
// along the columns of a matrix. The distance is found by projections, without the pieces.
template <int D>
struct Body {
  Vec<D> corner;
  Eigen::Matrix<double, D, D> axes;  // unit vectors at right angles
  Vec<D> lengths;                    // 0 along axes without extent
  double radius = 0.0;

  double distance(const Vec<D>& at) const {
    const Vec<D> place = axes.transpose() * (at - corner);
    return (place - place.cwiseMax(0.0).cwiseMin(lengths)).norm() - radius;
  }
};

template <int D>
Vec<D> random_point(Random& random, double size) {
  Vec<D> point;
  for (double& x : point) x = size * (2.0 * random.uniform() - 1.0);
  return point;
}

// Axes along random directions.
template <int D>
Eigen::Matrix<double, D, D> random_axes(Random& random) {
  Eigen::Matrix<double, D, D> axes;
  for (int k = 0; k < D; ++k) {
    Vec<D> axis = random_point<D>(random, 1.0);
    for (int l = 0; l < k; ++l) axis -= axis.dot(axes.col(l)) * axes.col(l);
    axes.col(k) = axis.normalized();
  }
  return axes;
}

// The first time at which a body at `gap` from a surface along a path touches it, by steps that are
// never longer than the way to the surface. Infinite without one before `end`.
template <class Gap, class Speed>
double traced_time(const Gap& gap, const Speed& speed_until, double end) {
  double t = 0.0;
  while (t < end) {
    const double distance = gap(t);
    if (distance <= 1e-11) return t;
    // The speed within the step is bounded by that at the end of a step of 0.1.
    t += std::min(0.1, distance / speed_until(t + 0.1));
  }
  return std::numeric_limits<double>::infinity();
}

struct Tally {
  int hits = 0, misses = 0, near_misses = 0;
};

// Compares the contact with pieces to a traced one. Touches shallower than 1e-9 may differ.
template <int D>
void compare(const std::vector<Piece<D>>& pieces, const Body<D>& body, const Flight<D>& flight,
             double radius, const Vec<D>& gravity, double end, Tally& tally) {
  const auto gap = [&](double t) {
    return body.distance(flight.at(flight.time + t, gravity)) - radius;
  };
  const auto speed = [&](double t) { return flight.v.norm() + gravity.norm() * t; };
  const double traced = traced_time(gap, speed, end);
  double found = kNever;
  for (const Piece<D>& piece : pieces) {
    found = std::min(
        found, piece_contact_time<D>(piece, flight, Vec<D>::Zero(), radius, gravity) - flight.time);
  }
  if (found > end) found = kNever;
  if (std::isinf(traced) != std::isinf(found)) {
    // Only a grazing touch may be seen by one of the two.
    const double t = std::isinf(found) ? traced : found;
    const double h = 1e-4;
    CHECK(std::fabs(gap(t)) < 1e-8);
    CHECK(std::fabs(gap(t + h) - gap(t - h)) / (2.0 * h) < 1e-2);
    ++tally.near_misses;
  } else if (std::isinf(found)) {
    ++tally.misses;
  } else {
    CHECK(std::fabs(gap(found)) < 1e-9);
    // A slow approach needs a longer time for the last 1e-11.
    CHECK(found == doctest::Approx(traced).epsilon(1e-6));
    ++tally.hits;
  }
}

// The pieces of a box of any rank: all its faces, edges and corners.
template <int D>
std::vector<Piece<D>> pieces_of(const Body<D>& body) {
  std::vector<Piece<D>> pieces;
  int rank = 0;
  for (const double length : body.lengths) rank += length > 0.0;
  // Of each axis: at its lower end (0), at its upper end (1), or along it (2).
  for (int code = 0; code < (D == 2 ? 9 : 27); ++code) {
    Vec<D> corner = body.corner;
    std::vector<Vec<D>> edges;
    bool exists = true;
    for (int axis = 0, rest = code; axis < D; ++axis, rest /= 3) {
      const Vec<D> edge = body.lengths[axis] * body.axes.col(axis);
      if (rest % 3 == 2) {
        exists = exists && body.lengths[axis] > 0.0;
        edges.push_back(edge);
      } else if (rest % 3 == 1) {
        exists = exists && body.lengths[axis] > 0.0;
        corner += edge;
      }
    }
    if (!exists || static_cast<int>(edges.size()) == D) continue;
    Piece<D> piece = flat_piece<D>(corner, edges);
    piece.radius = body.radius;
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

TEST_CASE_TEMPLATE("Pieces: the contacts of balls, plates and boxes are those of a traced path",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  for (const bool falls : {false, true}) {
    for (int rank = 0; rank <= D; ++rank) {
      CAPTURE(falls);
      CAPTURE(rank);
      Tally tally;
      for (std::uint32_t trial = 0; trial < 1000; ++trial) {
        Random random(17, Stream::Placement, trial, static_cast<std::uint32_t>(4 * D + rank));
        Body<D> body{random_point<D>(random, 1.0), random_axes<D>(random), Vec<D>::Zero()};
        for (int k = 0; k < rank; ++k) body.lengths[k] = 0.2 + 2.0 * random.uniform();
        if (rank == 0 && trial % 2 == 0) body.radius = 2.0 * random.uniform();
        const double radius = 0.1 + 0.6 * random.uniform();
        Flight<D> flight{random_point<D>(random, 3.0), Vec<D>::Zero(), random.uniform(), 0};
        // Roughly towards the body.
        flight.v = 0.5 * (body.corner + random_point<D>(random, 1.5) - flight.r);
        if (body.distance(flight.r) < radius + 1e-3) continue;
        const Vec<D> gravity = falls ? random_point<D>(random, 1.0) : Vec<D>(Vec<D>::Zero());
        compare<D>(pieces_of(body), body, flight, radius, gravity, 8.0, tally);
      }
      CHECK(tally.hits > 40);
      CHECK(tally.misses > 40);
      CHECK(tally.near_misses < 4);
    }
  }
}

// |x + v t + g t^2/2| = 5 with x = (0, 13), v = (2, 0), g = (0, -10): (2t)^2 + (13 - 5 t^2)^2 = 25
// is 25 t^4 - 126 t^2 + 144 = 0, and t^2 = 1.75234 or 3.28766; the first falls.
TEST_CASE("Pieces: a ball is met at the first falling root of the quartic") {
  const FallTimes falls = fall_times<2>({0.0, 13.0}, {2.0, 0.0}, {0.0, -10.0}, 5.0);
  REQUIRE(falls.count == 1);
  const double squared = (126.0 - std::sqrt(126.0 * 126.0 - 4.0 * 25.0 * 144.0)) / 50.0;
  CHECK(falls.times[0] == doctest::Approx(std::sqrt(squared)).epsilon(1e-14));
  // Thrown up from beside the ball, over it, and down on its other side.
  const FallTimes over = fall_times<2>({-7.0, 0.0}, {7.0, 10.0}, {0.0, -10.0}, 5.0);
  REQUIRE(over.count == 1);
  CHECK(Vec2(-7.0 + 7.0 * over.times[0], 10.0 * over.times[0] - 5.0 * over.times[0] * over.times[0])
            .norm() == doctest::Approx(5.0));
}

// A disk of radius 1/2 over the end of a plate from (0, 0) to (4, 0). From the left its foot is
// beside the plate; with gravity it passes the end and falls back on the other side.
TEST_CASE("Pieces: ends of plates have no gap, and a plate does not see a particle in its slit") {
  const Piece<2> plate = flat_piece<2>({0.0, 0.0}, {{4.0, 0.0}});
  const Piece<2> end = ball_piece<2>({0.0, 0.0}, 0.0);
  const auto met = [](const Piece<2>& piece, const Flight<2>& flight, const Vec2& gravity) {
    return piece_contact_time<2>(piece, flight, Vec2::Zero(), 0.5, gravity);
  };
  const Vec2 none = Vec2::Zero();
  // At the seam both answer at one time.
  const Flight<2> seam{{0.0, 2.5}, {0.0, -1.0}, 0.0, 0};
  CHECK(met(plate, seam, none) == 2.0);
  CHECK(met(end, seam, none) == 2.0);
  // Beside it only the end answers.
  const Flight<2> beside{{-0.3, 2.4}, {0.0, -1.0}, 0.0, 0};
  CHECK(met(plate, beside, none) == kNever);
  CHECK(met(end, beside, none) == doctest::Approx(2.0));
  // In the slit it passes the plane, whatever its direction.
  CHECK(met(plate, {{-1.0, 0.2}, {0.0, -1.0}, 0.0, 0}, none) == kNever);
  CHECK(met(plate, {{-1.0, -0.2}, {0.0, 1.0}, 0.0, 0}, none) == kNever);
  // From below through the slit, over the end and down on the upper face: y = 0.5 at the second
  // root of -2 + 4 t - t^2/2 = 0.5, at which x = 2.3.
  const Flight<2> back{{-2.0, -2.0}, {0.587, 4.0}, 0.0, 0};
  const double root = 4.0 + std::sqrt(11.0);
  CHECK(met(plate, back, {0.0, -1.0}) == doctest::Approx(root).epsilon(1e-14));
}

// A particle at rest on the top of a ball, or on a plate, is pressed on at once; one that moves
// away is not met again.
TEST_CASE("Pieces: a particle that touches is met again only if it is pressed on") {
  const Piece<2> ball = ball_piece<2>({0.0, 0.0}, 1.5);
  const Vec2 down(0.0, -1.0), none = Vec2::Zero();
  const auto met = [&](const Vec2& v, const Vec2& gravity) {
    return piece_contact_time<2>(ball, {{0.0, 2.0}, v, 3.0, 0}, Vec2::Zero(), 0.5, gravity);
  };
  CHECK(met({0.0, -1.0}, none) == 3.0);
  CHECK(met({0.0, 1.0}, none) == kNever);
  CHECK(met({1.0, 0.0}, none) == kNever);
  CHECK(met({0.0, 0.0}, down) == 3.0);
  CHECK(met({0.0, -1.0}, down) == 3.0);
  CHECK(met({0.0, 1.0}, down) == doctest::Approx(5.0));
  CHECK(met({0.0, 1.0}, -down) == kNever);
  CHECK(met({9.0, 0.0}, down) == kNever);
}

}  // namespace clatter::pieces
