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

/// The cost of a run.
struct Performance {
  double cpu_seconds = 0.0;
  double wall_seconds = 0.0;
  std::uint64_t collisions = 0;  ///< of disks, in this time
  std::uint64_t peak_memory_bytes = 0;
  std::size_t tiles = 0;  ///< into which the gas is divided; 0: it runs as a whole
};

/// The means of a result, by dotted names as in the result file, for example "energy.dissipated".
/// Those of a species have its name, "species.large.temperature", those of a pair both,
/// "pairs.small+large.dissipated".
std::vector<std::pair<std::string, Estimate>> estimates_of(const Measured& measured);

/// The place of a table in a result, or of a mean outside of lists, by its dotted name.
nlohmann::ordered_json::json_pointer estimate_pointer(std::string name);

/// The place of a mean in a result, by its name in estimates_of(); it is made if absent.
nlohmann::ordered_json& place_of_estimate(nlohmann::ordered_json& result, const std::string& name);

/// The result file of `clatter measure`. Parts that do not apply to the scene are absent.
template <int D>
nlohmann::ordered_json result_json(const Scene& scene, std::uint64_t seed,
                                   const Simulation<D>& simulation, const Measured& measured,
                                   const Performance& performance);

/// The text of a JSON value, indented by one space per level. Lists of plain values, such as series
/// and profiles, are on one line each.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace clatter
