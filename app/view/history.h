#pragma once

#include <array>
#include <vector>

#include "engine/publish/frame.h"

namespace clatter {

/// What has become of a gas between two frames, averaged over the time between them.
struct Sample {
  double time = 0.0;              ///< the middle of the time between
  Vec2 temperature = {0.0, 0.0};  ///< T_x, T_y
  double walls_in = 0.0;          ///< energy per time
  double bulk_in = 0.0;
  double gravity_in = 0.0;
  double dissipated = 0.0;
  double ledger_residual = 0.0;  ///< see Totals, its size
  double deepest_overlap = 0.0;  ///< see RunChecks
};

/// How often velocities fall into classes of equal width, over a while that reaches back some
/// seconds.
class VelocityHistogram {
 public:
  static constexpr int kClasses = 61;
  static constexpr double kReach = 5.0;  ///< in standard deviations, to either side

  /// Forgets all.
  void clear() { weights_ = {}; }
  /// Counts all disks of a frame.
  void add(const Snapshot& snapshot);
  /// Densities of v_x (0) or v_y (1) over its standard deviation, at the middles of the classes;
  /// 0 where none fell.
  std::vector<Vec2> density(int axis) const;

 private:
  std::array<std::array<double, kClasses>, 2> weights_ = {};
};

/// The course of a run as the plots show it: at most some thousand samples, the farther apart the
/// longer it gets.
class History {
 public:
  /// Takes a new frame.
  void add(const Frame& frame);

  /// In order of time.
  const std::vector<Sample>& samples() const { return samples_; }
  /// Of all disks over the last seconds.
  const VelocityHistogram& velocities() const { return velocities_; }

 private:
  void thin_out();

  std::uint64_t run_ = 0;
  Tally last_;
  double spacing_ = 0.0;  // least time between samples
  std::vector<Sample> samples_;
  VelocityHistogram velocities_;
};

}  // namespace clatter
