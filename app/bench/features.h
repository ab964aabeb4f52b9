#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// A feature that a gas has besides those of the bare gas.
struct Feature {
  std::string name;
  std::function<void(Scene&)> add;       ///< modifies the bare scene
  std::vector<Field> fields = {};        ///< measured during the run
  std::optional<double> snapshots = {};  ///< interval of snapshots; absent: exact
  double frames = 0.0;                   ///< published per time unit
  bool balance = false;                  ///< whether all balance equations are measured
  bool checkpoint = false;               ///< whether each round ends with a checkpoint
  std::optional<ObservableKind> observable = {};
};

/// The rows of the table of features: first the bare gas, last every observable of
/// `measure.observables`.
std::vector<Feature> features();

/// Prints the collision rate with each optional feature of a scene, relative to the rate of the
/// bare run: elastic disks in a periodic box. All runs alternate in one process. `count` is the
/// number of disks; 0: 1000. Writes the table also to `json`, unless it is empty. Returns the exit
/// code.
int bench_features(const std::string& json, int count);

}  // namespace clatter
