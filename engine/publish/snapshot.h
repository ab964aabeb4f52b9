#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/measure/field_map.h"
#include "engine/scene/view.h"
#include "engine/scene/wall.h"
#include "engine/vec.h"

namespace clatter {

/// A vector field on a coarser grid.
struct ArrowMap {
  /// A value and the centre of the cell that it stands for.
  struct Arrow {
    Vec2 place;
    Vec2 value;
  };

  Quantity quantity = Quantity::Velocity;  ///< what the values are
  Vec2 cell = {0.0, 0.0};     ///< extent of the cells, but that the last of a row may be smaller
  std::vector<Arrow> arrows;  ///< of the cells that have a value, row by row
};

/// A part of a particle's flight, between two of its events.
struct FlightPiece {
  std::uint32_t particle = 0;
  double from = 0.0, to = 0.0;     ///< times after the snapshot's, from < to <= 0
  Vec2 position = {0.0, 0.0};      ///< centre at `from`, wrapped into the box
  Vec2 velocity = {0.0, 0.0};      ///< at `from`
  Vec2 acceleration = {0.0, 0.0};  ///< of gravity

  /// The centre at a time; may lie outside a periodic box.
  Vec2 at(double time) const {
    const double dt = time - from;
    return position + (velocity + 0.5 * dt * acceleration) * dt;
  }
};

/// The gas at one instant, evaluated exactly: all that the renderer knows of the engine.
struct Snapshot {
  double time = 0.0;                          ///< simulation time
  Vec2 box = {0.0, 0.0};                      ///< Lx, Ly
  double diameter = 1.0;                      ///< of every particle
  std::array<std::optional<Wall>, 4> walls;   ///< indexed by Side; a pair absent: periodic
  std::array<double, 4> wall_displacement{};  ///< of each wall into the box at this time
  std::vector<Vec2> positions;   ///< [N] centres, wrapped into the box, in original order
  std::vector<Vec2> velocities;  ///< [N]
  std::vector<double> spins;     ///< [N] angular velocities; empty where none are carried
  std::vector<double> angles;  ///< [N] by which particles have turned, -pi..pi; empty: not observed
  double exposure = 0.0;       ///< time up to this one that the picture shows; 0: the instant
  std::vector<FlightPiece> flights;  ///< of that time, and of trails; empty: not observed
  std::optional<FieldMap> field;     ///< averaged over the view's window; absent: not asked for
  std::optional<ArrowMap> arrows;    ///< likewise
  double temperature = 0.0;          ///< granular temperature T = (m/2N) sum v^2
  std::uint64_t collisions = 0;      ///< disk-disk collisions since time 0
};

}  // namespace clatter
