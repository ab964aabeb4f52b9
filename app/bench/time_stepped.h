#pragma once

#include <cstdint>
#include <vector>

#include "engine/physics/state.h"
#include "engine/scene/scene.h"

namespace clatter {

/// The sums of a time-stepped run.
struct SteppedSums {
  double time = 0.0;
  std::uint64_t collisions = 0;      ///< of disks
  double squares = 0.0;              ///< time integral of sum v^2
  double wall_impulse = 0.0;         ///< of both walls
  double stress = 0.0;               ///< time integral of the stress along the axis, times area
  double dissipated = 0.0;           ///< dissipated energy
  double deepest_overlap = 0.0;      ///< of two disks, in diameters, before it is resolved
  std::vector<double> particles;     ///< [columns] time integral of the number of disks
  std::vector<double> heat_carried;  ///< [columns] time integral of the heat flux times the area
};

/// A gas in fixed time steps, as in games and introductory courses. All disks move for one time
/// step; then overlapping disks collide and are separated. Smooth disks between two static or
/// driven walls, periodic along them. Serves as a reference for the exact engine, not as a mode of
/// the program.
class TimeStepped {
 public:
  /// Whether this engine supports all features of a scene.
  static bool can_run(const Scene& scene);

  /// Starts from a state. `columns` is the number of columns of the profiles from wall to wall.
  TimeStepped(const Scene& scene, const State<2>& state, double step, int columns);

  /// Runs for a time, rounded to whole steps.
  void run(double time);
  /// Sets all sums to zero.
  void restart_sums();

  /// The sums since restart_sums().
  const SteppedSums& sums() const { return sums_; }
  /// Memory of the arrays, bytes.
  double bytes() const;

 private:
  void advance();
  void hit_walls();
  void sort_into_cells();
  void resolve_overlaps();
  void resolve(std::uint32_t first, std::uint32_t second);
  void bounce(std::uint32_t first, std::uint32_t second, const Vec2& separation);
  void observe();
  void add_heat(double from, double to, double heat);
  Vec2 nearest(Vec2 separation) const;
  int cell_of(const Vec2& position) const;
  int column_of(double place) const;

  int axis_;  // from wall to wall
  Vec2 box_;
  double restitution_;
  std::array<Wall, 2> walls_;
  double step_;
  std::vector<Vec2> positions_, velocities_;
  std::array<int, 2> cells_;
  std::vector<int> starts_;            // [cells + 1] into sorted_
  std::vector<std::uint32_t> sorted_;  // disks sorted by cell
  SteppedSums sums_;
};

}  // namespace clatter
