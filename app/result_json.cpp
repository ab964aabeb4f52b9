#include "app/result_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/theory_json.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/scene_keys.h"

namespace clatter {

using Json = nlohmann::ordered_json;

static Json estimate_json(const Estimate& estimate) {
  return {{"mean", estimate.mean}, {"standard_error", estimate.standard_error}};
}

static Json pressure_json(const Measured& measured) {
  Json json = Json::object();
  for (int side = 0; side < 4; ++side) {
    if (measured.pressure[side]) json[kSideNames[side]] = estimate_json(*measured.pressure[side]);
  }
  if (measured.compressibility) json["virial"] = estimate_json(*measured.compressibility);
  return json;
}

static Json energy_json(const Measured& measured) {
  Json json = Json::object();
  if (measured.walls_in) json["walls_in"] = estimate_json(*measured.walls_in);
  if (measured.bulk_in) json["bulk_in"] = estimate_json(*measured.bulk_in);
  if (measured.gravity_in) json["gravity_in"] = estimate_json(*measured.gravity_in);
  json["dissipated"] = estimate_json(measured.dissipated);
  json["ledger_residual"] = measured.ledger_residual;
  return json;
}

static Json profile_json(const Profile& profile) {
  Json json{{"axis", name_of(profile.axis, kAxes)}, {"edges", profile.edges}};
  Json errors = Json::object();
  for (const Field field : profile.fields) {
    const std::string name(name_of(field, kHeatmaps));
    for (const Estimate& e : profile.at(field)) {
      // A column that was never visited has no temperature: null.
      json[name].push_back(std::isfinite(e.mean) ? Json(e.mean) : Json(nullptr));
      errors[name].push_back(e.standard_error);
    }
  }
  json["standard_error"] = errors;
  return json;
}

// The largest of Eqs. (4.1)-(4.3), of momentum that of its components.
static Json balance_json(const Residuals& residuals) {
  const Conserved<2> largest = residuals.largest();
  return {
      {"mass", largest[0]}, {"momentum", std::max(largest[1], largest[2])}, {"energy", largest[3]}};
}

Json result_json(const Scene& scene, std::uint64_t seed, const Simulation<2>& simulation,
                 const Measured& measured, const Performance& performance) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx",
                static_cast<unsigned long long>(simulation.state_hash()));
  Json json;
  json["schema"] = 1;
  json["scene"] = Json::parse(scene_to_json(scene));
  json["seed"] = seed;
  json["program"] = "clatter " CLATTER_VERSION;
  json["state_hash"] = hash;
  json["time"] = {{"burn_in", measured.burn_in}, {"measured", measured.duration}};
  json["events"] = {{"disk_disk", measured.disk_disk}, {"disk_wall", measured.disk_wall}};
  if (scene.bulk_drive) json["events"]["kicks"] = measured.kicks;
  if (scene.contact_time) json["events"]["elasticised"] = measured.elasticised;
  // A run that was interrupted in its burn-in has no averages, and nor have no disks.
  const bool averaged = measured.duration > 0.0;
  if (averaged) {
    json["temperature"] = estimate_json(measured.temperature);
    json["temperature_x"] = estimate_json(measured.temperature_x);
    json["temperature_y"] = estimate_json(measured.temperature_y);
    if (measured.spin_temperature) {
      json["spin_temperature"] = estimate_json(*measured.spin_temperature);
    }
  }
  json["temperature_series"] = {{"time", measured.series_time},
                                {"translational", measured.series_temperature}};
  if (scene.spins()) json["temperature_series"]["spin"] = measured.series_spin_temperature;
  if (averaged) {
    json["kurtosis_excess_x"] = estimate_json(measured.kurtosis_excess_x);
    json["kurtosis_excess_y"] = estimate_json(measured.kurtosis_excess_y);
    json["collision_rate"] = estimate_json(measured.collision_rate);
    json["energy"] = energy_json(measured);
  }
  if (Json pressure = pressure_json(measured); !pressure.empty()) json["pressure"] = pressure;
  json["theory"] = theory_json(scene);
  if (measured.profile) json["profile"] = profile_json(*measured.profile);
  if (measured.residuals) json["balance"] = balance_json(*measured.residuals);
  json["checks"] = {{"deepest_overlap", simulation.checks().deepest_overlap},
                    {"clock_steps_back", simulation.checks().clock_steps_back}};
  if (scene.contact_time) {
    const double collisions = std::max<double>(1.0, static_cast<double>(measured.disk_disk));
    json["checks"]["elasticised_share"] = static_cast<double>(measured.elasticised) / collisions;
  }
  if (measured.undissipated_share) {
    json["checks"]["undissipated_share"] = *measured.undissipated_share;
  }
  const double collisions = static_cast<double>(simulation.counts().disk_disk);
  json["performance"] = {
      {"cpu_seconds", performance.cpu_seconds},
      {"collisions_per_second",
       performance.cpu_seconds > 0.0 ? collisions / performance.cpu_seconds : 0.0},
      {"peak_memory_bytes", performance.peak_memory_bytes}};
  return json;
}

}  // namespace clatter
