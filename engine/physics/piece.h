#pragma once

#include <array>
#include <utility>
#include <vector>

#include "engine/physics/flight.h"
#include "engine/vec.h"

// Fixtures consist of pieces, and a particle touches one piece at a time. A plate is a segment in
// 2D and a rectangle in 3D. Its ends are pieces of their own: points in 2D, rims and points in 3D.
// The ends of a plate are closed sets, and so are the feet of contacts. At a seam both pieces
// answer with the same time and normal, and no particle passes between them.

namespace clatter {

/// A fixed body: all points within `radius` of a point, a segment or a rectangle (theory 13.1).
template <int D>
struct Piece {
  Vec<D> corner = Vec<D>::Zero();          ///< the point, or one end of all edges
  int rank = 0;                            ///< number of edges: 0 a point, D - 1 a plate
  std::array<Vec<D>, D - 1> directions;    ///< [rank] of the edges, unit vectors at right angles
  std::array<double, D - 1> lengths = {};  ///< [rank] of the edges, > 0
  Vec<D> normal = Vec<D>::Zero();          ///< of a plate, a unit vector; either face touches
  double radius = 0.0;                     ///< of a ball; 0 for all other pieces

  /// Whether it has two faces.
  bool is_plate() const { return rank == D - 1; }
  /// The point of the edges that is nearest to a position.
  Vec<D> foot(const Vec<D>& position) const;
  /// Distance of a position from the surface; of a ball negative inside.
  double distance(const Vec<D>& position) const;
  /// Its lowest and highest coordinates.
  std::pair<Vec<D>, Vec<D>> bounds() const;
  /// Whether particles touch both at the same places.
  bool operator==(const Piece& other) const;
  /// Unit vector at the contact with a particle, from the piece to the centre.
  Vec<D> normal_at(const Vec<D>& position) const;
};

/// A ball, or for radius 0 a point.
template <int D>
Piece<D> ball_piece(const Vec<D>& centre, double radius);

/// A segment or rectangle: one corner, and the edges from there, at right angles to each other.
template <int D>
Piece<D> flat_piece(const Vec<D>& corner, const std::vector<Vec<D>>& edges);

/// Time at which a particle of some radius first touches a piece, or kNever. `shift` is added to
/// the positions of the flight and selects the periodic image. With gravity it is the first time at
/// which the distance falls to that of contact, and the foot is on the piece. A particle that
/// already touches the piece does so at once, if it approaches faster than the rounding of its
/// velocity, or if gravity presses it on.
template <int D>
double piece_contact_time(const Piece<D>& piece, const Flight<D>& flight, const Vec<D>& shift,
                          double radius, const Vec<D>& gravity);

/// Time at which the centre of a particle crosses a plate in either direction, or kNever. A centre
/// that begins on the plate, within rounding, has crossed it.
template <int D>
double crossing_time(const Piece<D>& plate, const Flight<D>& flight, const Vec<D>& shift,
                     const Vec<D>& gravity);

/// Times t >= 0 at which |x + v t + g t^2/2| falls to a distance, in order: none, one or two.
struct FallTimes {
  int count = 0;
  std::array<double, 2> times = {};
};
template <int D>
FallTimes fall_times(const Vec<D>& x, const Vec<D>& v, const Vec<D>& g, double distance);

}  // namespace clatter
