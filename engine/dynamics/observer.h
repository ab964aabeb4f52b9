#pragma once

#include <array>
#include <cstdint>

#include "engine/physics/flight.h"
#include "engine/vec.h"

namespace clatter {

/// A collision of two disks. Index 0 and 1 are the partners, the lower number first.
template <int D>
struct PairCollision {
  double time = 0.0;  ///< on the moving base
  std::array<std::uint32_t, 2> disks{};
  std::array<Flight<D>, 2> before;     ///< flights that end here
  std::array<Vec<D>, 2> position;      ///< centres, in the frames of those flights
  Vec<D> separation = Vec<D>::Zero();  ///< r_0 - r_1 at the image that touches
  Vec<D> impulse = Vec<D>::Zero();     ///< momentum that disk 0 gains, disk 1 loses
  std::array<double, 2> energy{};      ///< kinetic energy that each gains
};

/// A collision of a disk with a wall.
template <int D>
struct WallCollision {
  double time = 0.0;  ///< on the moving base
  std::uint32_t disk = 0;
  int side = 0;                      ///< the Side
  Flight<D> before;                  ///< flight that ends here
  Vec<D> position = Vec<D>::Zero();  ///< centre, in the frame of that flight
  Vec<D> impulse = Vec<D>::Zero();   ///< momentum that the disk gains
  double energy = 0.0;               ///< kinetic energy that the disk gains
};

/// Something that watches the events of a run; it cannot change it. A disk's flights follow each
/// other without gaps, so what is integrated along them is exact.
template <int D>
class Observer {
 public:
  virtual ~Observer() = default;
  /// Two disks have collided; the simulation still holds the flights before.
  virtual void on_collision(const PairCollision<D>&) {}
  /// A disk has hit a wall; likewise.
  virtual void on_wall(const WallCollision<D>&) {}
  /// All times on the moving base have become smaller by `shift`.
  virtual void on_base_moved(double /*shift*/) {}
};

}  // namespace clatter
