#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/system/progress.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Runs of one scene with different seeds.
struct Ensemble {
  int replicas = 1;
  std::uint64_t first_seed = 1;  ///< the other seeds follow it
  double end = 0.0;              ///< simulation time of each
  std::optional<int> threads;    ///< number of threads; absent: the number of processors
};

/// Measures the replicas. The result has the means over the replicas, with standard errors from
/// their scatter, under the usual names. The array "results" has the result of `clatter measure
/// --seed` for each replica, without performance. After an interrupt the result has the finished
/// replicas. If a replica stops or fails a check, throws PhysicalStop or RunError, which names the
/// first failed seed.
nlohmann::ordered_json measure_ensemble(const Scene& scene, const Ensemble& ensemble,
                                        Progress& progress);

}  // namespace clatter
