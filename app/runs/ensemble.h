#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/system/progress.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Runs of a scene that differ in their seed alone.
struct Ensemble {
  int replicas = 1;
  std::uint64_t first_seed = 1;  ///< the others follow it
  double end = 0.0;              ///< simulation time of each
  std::optional<int> threads;    ///< that run them; absent: as many as there are processors
};

/// Measures the replicas. The result has the means over
/// replicas with the standard errors that these scatter by, by the names that results have, and
/// under "results" what `clatter measure --seed` would write for each, without performance. After
/// an interrupt it has the replicas that were done. Where one stops, or is not sound, the rest is
/// left out: throws PhysicalStop or RunError, which name the first such seed.
nlohmann::ordered_json measure_ensemble(const Scene& scene, const Ensemble& ensemble,
                                        Progress& progress);

}  // namespace clatter
