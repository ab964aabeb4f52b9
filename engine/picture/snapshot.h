#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/laws/wall.h"
#include "engine/measure/field_map.h"
#include "engine/physics/grain.h"
#include "engine/scene/obstacle.h"
#include "engine/scene/species.h"
#include "engine/scene/view.h"
#include "engine/vec.h"

// Exact frames. Free flight is closed-form, so the state at a frame's time is evaluated without
// advancing any disk. Fields integrate each flight through the cells that it crosses.

namespace clatter {

template <int D>
class Simulation;

/// A vector field on a coarser grid.
struct ArrowMap {
  /// A value and the centre of its cell.
  struct Arrow {
    VecX place;
    VecX value;
  };

  Quantity quantity = Quantity::Velocity;  ///< quantity of the values
  VecX cell;                  ///< extent of the cells; the last of a row may be smaller
  std::vector<Arrow> arrows;  ///< of the cells that have a value, row by row
};

/// A part of a particle's flight, between two of its events. It ends where it crosses the border of
/// a sheared box.
struct FlightPiece {
  std::uint32_t particle = 0;
  double from = 0.0, to = 0.0;  ///< times relative to the snapshot's time, from < to <= 0
  VecX position;                ///< centre at `from`, wrapped into the box
  VecX velocity;                ///< at `from`, also of the flow
  VecX acceleration;            ///< of gravity

  /// The centre at a time; may be outside a periodic box.
  VecX at(double time) const {
    const double dt = time - from;
    return position + (velocity + 0.5 * dt * acceleration) * dt;
  }
};

/// The gas at one instant, evaluated exactly. The renderer has no other data of the engine. As in a
/// Scene, the dimension D is the number of components of the box.
struct Snapshot {
  double time = 0.0;                          ///< simulation time
  VecX box;                                   ///< extents [D]: Lx, Ly and, of spheres, Lz
  double diameter = 1.0;                      ///< of every particle, in a mixture of the largest
  std::array<std::optional<Wall>, 6> walls;   ///< indexed by Side; a pair absent: periodic
  std::array<double, 6> wall_displacement{};  ///< of each wall into the box at this time
  double slide = 0.0;   ///< velocity along x of the next image above, in a sheared box; else 0
  double offset = 0.0;  ///< displacement along x of this image at this time, 0 <= offset < Lx
  double piston_travel = 0.0;                 ///< of the right wall's rest position into the box
  std::optional<double> free_piston;          ///< place of its middle; absent: there is none
  Vectors positions;                  ///< [D][N] centres, wrapped into the box, in original order
  Vectors velocities;                 ///< [D][N], in a sheared box without that of the flow
  std::vector<Grain> grains;          ///< [N] what the particles are; empty: all alike
  std::vector<Species> species;       ///< of the scene, for colours and legends; empty: all alike
  std::vector<Obstacle> obstacles;    ///< that are present, and a thick piston
  std::vector<Partition> partitions;  ///< that are present, and a piston without thickness
  Vectors spins;               ///< [1][N], of spheres [3][N] angular velocities; empty: no spins
  std::vector<double> angles;  ///< [N] rotation angles of disks, -pi..pi; empty: not observed
  /// [N] rotations of spheres from their start, unit quaternions; empty: not observed
  std::vector<Eigen::Quaterniond> orientations;
  double exposure = 0.0;             ///< exposure time, which ends at `time`; 0: an instant
  std::vector<FlightPiece> flights;  ///< of the exposure and of trails; empty: not observed
  std::vector<FlightPiece> traced;   ///< of View::tracer; empty: not observed
  std::optional<FieldMap> field;     ///< averaged over the view's window; absent: not requested
  std::optional<ArrowMap> arrows;    ///< averaged over the view's window; absent: not requested
  double temperature = 0.0;          ///< granular temperature T = (m/DN) sum v^2
  std::uint64_t collisions = 0;      ///< between particles, since time 0

  /// The number N of particles.
  std::size_t count() const { return static_cast<std::size_t>(positions.cols()); }
  /// The radius of particle `i`.
  double radius(std::size_t i) const { return grains.empty() ? 0.5 * diameter : grains[i].radius; }
  /// The radius of the smallest particle.
  double smallest_radius() const {
    double smallest = 0.5 * diameter;
    for (const Grain& grain : grains) smallest = std::min(smallest, grain.radius);
    return smallest;
  }
};

/// The gas at the simulation's time, without a field, the names of species and fixtures.
template <int D>
Snapshot snapshot_of(const Simulation<D>& simulation);

}  // namespace clatter
