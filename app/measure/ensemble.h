#pragma once

#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/system/progress.h"
#include "engine/scene/scene.h"

namespace clatter {

/// Runs of one scene with different seeds.
struct Ensemble {
  int replicas = 1;
  std::uint64_t first_seed = 1;  ///< the other seeds follow it
  double end = 0.0;              ///< simulation time of each
  std::optional<int> threads;    ///< number of threads; absent: fitting_processors()
};

/// The result of the complete replicas, and the error of a failed one.
struct EnsembleResult {
  /// The means over the replicas, with standard errors from their scatter, under the usual names.
  /// The array "results" has the result of `clatter measure --seed` for each complete replica,
  /// without performance.
  nlohmann::ordered_json json;
  /// PhysicalStop or RunError with the first failed seed; null if no replica has stopped or failed.
  std::exception_ptr failure;
};

/// Measures the replicas, until an interrupt or a failure.
EnsembleResult measure_ensemble(const Scene& scene, const Ensemble& ensemble, Progress& progress);

}  // namespace clatter
