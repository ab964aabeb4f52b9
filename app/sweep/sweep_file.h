#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/measure/accuracy_goal.h"
#include "engine/scene/scene_file.h"

namespace clatter {

/// The settings of a point of a sweep: one value of each axis, in the order of the axes.
using SweepPoint = std::vector<Override>;

/// Further points between the values of the first axis, where the measured curve bends or is
/// uncertain.
struct Refinement {
  int budget = 0;  ///< number of points at its end
};

/// A sweep file: runs of one scene at points of its parameters.
struct Sweep {
  std::string scene;                       ///< path, relative to the sweep file, or gallery name
  std::vector<Override> set;               ///< settings of all runs
  std::vector<std::uint64_t> seeds = {1};  ///< of the replicas of each point
  AccuracyGoal accuracy;                   ///< end of each run; none: the end of the scene
  std::optional<double> until;             ///< latest end of each run, in simulation time
  /// The parameters that vary. The keys of one group vary together.
  std::vector<std::vector<std::string>> groups;
  /// [groups][entries] The values of a group, in the order of the file.
  std::vector<std::vector<SweepPoint>> entries;

  std::optional<Refinement> refinement;  ///< absent: none
  /// Whether the first axis is a logarithmic range.
  bool logarithmic = false;

  /// The keys of all groups.
  std::vector<std::string> axes() const;
  /// The settings of the runs at a point: those of all runs, then those of the point.
  std::vector<Override> settings_at(const SweepPoint& point) const;
  /// The product of all groups. The entries of the last group vary fastest.
  std::vector<SweepPoint> points() const;
};

/// The text of a sweep file. Throws UserError if it cannot be read or has more than 1 MB.
std::string sweep_text(const std::string& file);

/// Reads a sweep file from its text. `file` is the name for errors. Throws UserError with file,
/// line, column, problem and fix.
Sweep read_sweep(const std::string& text, const std::string& file);

/// Throws UserError at the first entry with which the scene is invalid. Each entry is tested with
/// the first entries of all other groups.
void check_entries(const Sweep& sweep, const SceneText& scene, const std::string& text,
                   const std::string& file);

/// "particles.count=50 particles.restitution=0.9".
std::string settings_text(const std::vector<Override>& settings);

}  // namespace clatter
