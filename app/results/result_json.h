#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/measure/measurement.h"
#include "engine/scene/scene.h"

namespace clatter {

/// What a run cost.
struct Performance {
  double cpu_seconds = 0.0;
  double wall_seconds = 0.0;
  std::uint64_t collisions = 0;  ///< of disks, in that time
  std::uint64_t peak_memory_bytes = 0;
};

/// The means of a result by their dotted names in the result file, e.g. "energy.dissipated".
std::vector<std::pair<std::string, Estimate>> estimates_of(const Measured& measured);

/// Where in a result a mean of that name stands.
nlohmann::ordered_json::json_pointer estimate_pointer(std::string name);

/// The result file of `clatter measure`: parts that the scene does not have are absent.
template <int D>
nlohmann::ordered_json result_json(const Scene& scene, std::uint64_t seed,
                                   const Simulation<D>& simulation, const Measured& measured,
                                   const Performance& performance);

}  // namespace clatter
