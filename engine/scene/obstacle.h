#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/laws/wall.h"
#include "engine/scene/species.h"
#include "engine/vec.h"

namespace clatter {

/// How particles leave a fixture. It is static; with a drive speed it is driven, and with a
/// temperature thermal.
struct FixtureLaw {
  SpeciesWall of_all;                   ///< absent members: elastic, smooth, at rest
  std::vector<SpeciesWall> of_species;  ///< [S] differences of each species

  /// The law for all species.
  Wall wall() const;
  /// The law for one species, by its number.
  Wall wall(std::size_t species) const;

  bool operator==(const FixtureLaw&) const = default;
};

/// Shape of an obstacle.
enum class ObstacleKind { Ball, Polygon, Box };

/// A body at rest in the box.
struct Obstacle {
  std::optional<std::string> name;  ///< absent: "obstacle_1" and so on, see obstacle_name()
  ObstacleKind kind = ObstacleKind::Ball;
  VecX centre = Vec2::Zero();  ///< of a ball
  double radius = 1.0;         ///< of a ball, > 0
  std::vector<Vec2> corners;   ///< of a polygon in 2D, in order around it
  VecX from = Vec2::Zero();    ///< lowest corner of a box
  VecX to = Vec2::Zero();      ///< highest corner of a box
  bool present = true;         ///< false: not there now, until a change
  FixtureLaw law;

  bool operator==(const Obstacle&) const = default;
};

/// A side of a partition, along its axis.
enum class PartitionSide { Left, Right };

/// Particles that pass a hole, see Valve. The others are reflected.
struct HoleValve {
  std::optional<double> faster_than;  ///< least speed that passes; absent: any
  std::optional<double> slower_than;  ///< speed that no longer passes; absent: any
  std::optional<PartitionSide> from;  ///< side from which they pass; absent: both

  bool operator==(const HoleValve&) const = default;
};

/// An opening of a partition: an interval, or a rectangle in 3D, along the other axes in order.
struct Hole {
  std::vector<double> from = {0.0};  ///< [D - 1]
  std::vector<double> to = {0.0};    ///< [D - 1]
  std::optional<HoleValve> valve = {};  ///< absent: all that fit pass

  bool operator==(const Hole&) const = default;
};

/// A thin wall across the box, at right angles to an axis.
struct Partition {
  std::optional<std::string> name;  ///< absent: "partition_1" and so on
  Axis axis = Axis::X;
  double position = 0.0;            ///< along the axis
  std::vector<Hole> holes;          ///< apart from each other; none: closed
  std::vector<std::string> passes;  ///< names of species that do not see it
  bool present = true;              ///< false: not there now, until a change
  FixtureLaw law;

  bool operator==(const Partition&) const = default;
};

/// A plate across the box that slides freely between two walls, see FreePiston.
struct Piston {
  Axis axis = Axis::X;
  double position = 0.0;   ///< of its middle at time 0
  double mass = 1.0;       ///< > 0
  double thickness = 0.0;  ///< along the axis, >= 0
  double speed = 0.0;      ///< along the axis at time 0
  double force = 0.0;      ///< constant, along the axis
  bool pinned = false;     ///< whether it is held at rest
  FixtureLaw law;          ///< static

  bool operator==(const Piston&) const = default;
};

/// The name of an obstacle in results and messages, by its place in the list.
std::string obstacle_name(const Obstacle& obstacle, std::size_t number);
/// The same of a partition.
std::string partition_name(const Partition& partition, std::size_t number);

}  // namespace clatter
