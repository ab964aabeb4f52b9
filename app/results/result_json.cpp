#include "app/results/result_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/results/theory_json.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/scene_file.h"

namespace clatter {

using Json = nlohmann::ordered_json;

static Json estimate_json(const Estimate& estimate) {
  return {{"mean", estimate.mean}, {"standard_error", estimate.standard_error}};
}

std::vector<std::pair<std::string, Estimate>> estimates_of(const Measured& measured) {
  std::vector<std::pair<std::string, Estimate>> estimates;
  const auto add = [&](const std::string& name, const std::optional<Estimate>& estimate) {
    if (estimate) estimates.emplace_back(name, *estimate);
  };
  add("temperature", measured.temperature);
  const auto add_axes = [&](const std::string& name, const std::vector<Estimate>& estimates) {
    for (std::size_t axis = 0; axis < estimates.size(); ++axis) {
      add(name + '_' + std::string(kAxes[axis].name), estimates[axis]);
    }
  };
  add_axes("temperature", measured.axis_temperatures);
  add("spin_temperature", measured.spin_temperature);
  add_axes("kurtosis_excess", measured.kurtosis_excess);
  add("collision_rate", measured.collision_rate);
  add("energy.walls_in", measured.walls_in);
  add("energy.bulk_in", measured.bulk_in);
  add("energy.nudges_in", measured.nudges_in);
  add("energy.gravity_in", measured.gravity_in);
  add("energy.shear_in", measured.shear_in);
  add("energy.dissipated", measured.dissipated);
  if (const auto& shear = measured.shear) {
    add("shear.stress_xx", shear->stress[0][0]);
    add("shear.stress_yy", shear->stress[1][1]);
    add("shear.stress_yx", shear->stress[1][0]);
    add("shear.stress_xy", shear->stress[0][1]);
    add("shear.power", measured.shear_in);
    add("shear.viscosity", shear->viscosity);
  }
  for (std::size_t side = 0; side < measured.pressure.size(); ++side) {
    add("pressure." + std::string(kSideNames[side]), measured.pressure[side]);
  }
  for (std::size_t side = 0; side < measured.shear_stress.size(); ++side) {
    for (std::size_t axis = 0; axis < measured.shear_stress[side].size(); ++axis) {
      add("shear_stress." + std::string(kSideNames[side]) + '.' + std::string(kAxes[axis].name),
          measured.shear_stress[side][axis]);
    }
  }
  add("pressure.virial", measured.compressibility);
  for (const SpeciesMeans& species : measured.species) {
    const std::string place = "species." + species.name + '.';
    add(place + "temperature", species.temperature);
    add_axes(place + "temperature", species.axis_temperatures);
    add(place + "spin_temperature", species.spin_temperature);
    for (std::size_t axis = 0; axis < species.mean_position.size(); ++axis) {
      add(place + "mean_position." + std::to_string(axis), species.mean_position[axis]);
    }
    add(place + "bulk_in", species.bulk_in);
    add(place + "walls_in", species.walls_in);
  }
  for (const PairMeans& pair : measured.pairs) {
    const std::string place = "pairs." + pair.species[0] + '+' + pair.species[1] + '.';
    add(place + "collision_rate", pair.collision_rate);
    add(place + "dissipated", pair.dissipated);
  }
  for (const FixtureMeans& fixture : measured.fixtures) {
    const std::string place = "fixtures." + fixture.name + '.';
    const auto add_list = [&](const std::string& name, const std::vector<Estimate>& components) {
      for (std::size_t k = 0; k < components.size(); ++k) {
        add(place + name + '.' + std::to_string(k), components[k]);
      }
    };
    add_list("force", fixture.force);
    add_list("torque", fixture.torque);
    add(place + "power", fixture.power);
    for (const auto& [species, rate] : fixture.hits) {
      add(place + "hits" + (species.empty() ? "" : '.' + species), rate);
    }
  }
  if (const auto& piston = measured.piston) {
    add("piston.position", piston->position);
    add("piston.variance", piston->variance);
    add("piston.temperature", piston->temperature);
    add("piston.force_left", piston->force_left);
    add("piston.force_right", piston->force_right);
    add("piston.hits_left", piston->hits_left);
    add("piston.hits_right", piston->hits_right);
    add("piston.power", piston->power);
    add("piston.dissipated", piston->dissipated);
  }
  if (const auto& compartments = measured.compartments) {
    add("compartments.count_left", compartments->count_left);
    add("compartments.share_left", compartments->share_left);
    add("compartments.imbalance", compartments->imbalance);
    add("compartments.temperature_left", compartments->temperature_left);
    add("compartments.temperature_right", compartments->temperature_right);
  }
  for (const ObservableResult& observable : measured.observables) {
    for (const auto& [name, mean] : observable.means) add(name, mean);
  }
  return estimates;
}

Json::json_pointer estimate_pointer(std::string name) {
  std::ranges::replace(name, '.', '/');
  return Json::json_pointer("/" + name);
}

// The item of a list that is about these species. New items are added at the end.
static Json& item_about(Json& list, const char* key, const Json& species) {
  for (Json& item : list) {
    if (item.at(key) == species) return item;
  }
  list.push_back({{key, species}});
  return list.back();
}

Json& place_of_estimate(Json& result, const std::string& name) {
  const std::size_t first = name.find('.'), second = name.find('.', first + 1);
  const std::string group = name.substr(0, first);
  if (group != "species" && group != "pairs" && group != "fixtures") {
    return result[estimate_pointer(name)];
  }
  const std::string about = name.substr(first + 1, second - first - 1);
  const std::size_t plus = about.find('+');
  Json& item = group != "pairs" ? item_about(result[group], "name", about)
                                : item_about(result[group], "species",
                                             {about.substr(0, plus), about.substr(plus + 1)});
  return item[estimate_pointer(name.substr(second + 1))];
}

// The results of each species: first its name and number, then its means. A mean position has a
// place for each axis, null along periodic ones.
static Json species_json(const std::vector<SpeciesMeans>& all) {
  Json json = Json::array();
  for (const SpeciesMeans& species : all) {
    Json& item = json.emplace_back(Json{{"name", species.name}, {"count", species.count}});
    if (species.elasticised_share) item["elasticised_share"] = *species.elasticised_share;
    for (const auto& position : species.mean_position) {
      item["mean_position"].push_back(position ? estimate_json(*position) : Json(nullptr));
    }
  }
  return json;
}

static Json profile_json(const Profile& profile) {
  Json json{{"axis", name_of(profile.axis, kAxes)}, {"edges", profile.edges}};
  Json errors = Json::object();
  for (std::size_t f = 0; f < profile.fields.size(); ++f) {
    const std::string name = profile.name(f);
    for (const Estimate& e : profile.values[f]) {
      // A column without particles has no temperature: null.
      json[name].push_back(std::isfinite(e.mean) ? Json(e.mean) : Json(nullptr));
      errors[name].push_back(e.standard_error);
    }
  }
  json["standard_error"] = errors;
  return json;
}

// Adds the table of an observable: a list for each column, and the errors as in profile_json().
static void add_table(Json& json, const ResultTable& table) {
  Json& place = json[estimate_pointer(table.name)];
  for (const TableColumn& column : table.columns) {
    place[column.name] = column.values;
    if (!column.standard_errors.empty()) {
      place["standard_error"][column.name] = column.standard_errors;
    }
  }
}

// The largest residual of each equation (theory 9.1-9.3). For momentum, the largest of all
// components. Of a mixture also that of the numbers of each species.
static Json balance_json(const Residuals& residuals) {
  const std::vector<double> largest = residuals.largest();
  Json json{{"mass", largest.front()},
            {"momentum", *std::max_element(largest.begin() + 1, largest.end() - 1)},
            {"energy", largest.back()}};
  if (!residuals.numbers.empty()) json["number"] = std::ranges::max(residuals.numbers);
  return json;
}

// A density in bins of equal width from 0 to 1.
static Json distribution_json(const std::vector<Estimate>& bins) {
  Json json;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    const auto count = static_cast<double>(bins.size());
    json["edges"].push_back(static_cast<double>(k) / count);
    json["density"].push_back(bins[k].mean);
    json["standard_error"]["density"].push_back(bins[k].standard_error);
  }
  json["edges"].push_back(1.0);
  return json;
}

template <int D>
Json result_json(const Scene& scene, std::uint64_t seed, const Simulation<D>& simulation,
                 const Measured& measured, const Performance& performance) {
  Json json;
  json["schema"] = 1;
  json["scene"] = Json::parse(scene_to_json(scene));
  json["seed"] = seed;
  json["program"] = "clatter " CLATTER_VERSION;
  json["state_hash"] = fmt::format("{:016x}", simulation.state_hash());
  json["time"] = {{"burn_in", measured.burn_in}, {"measured", measured.duration}};
  json["events"] = {{"disk_disk", measured.pair_collisions},
                    {"disk_wall", measured.wall_collisions}};
  if (scene.bulk_drive || measured.kicks > 0) json["events"]["kicks"] = measured.kicks;
  const bool elasticises = scene.contact_time || measured.elasticised > 0;
  if (elasticises) json["events"]["elasticised"] = measured.elasticised;
  // A run interrupted during the burn-in has no averages. A run without disks has none either.
  const bool averaged = measured.duration > 0.0;
  if (averaged) {
    if (!measured.species.empty()) json["species"] = species_json(measured.species);
    for (const auto& [name, estimate] : estimates_of(measured)) {
      place_of_estimate(json, name) = estimate_json(estimate);
    }
    json["energy"]["ledger_residual"] = measured.ledger_residual;
  }
  json["temperature_series"] = {{"time", measured.series.times},
                                {"translational", measured.series.temperature}};
  if (simulation.model().spins)
    json["temperature_series"]["spin"] = measured.series.spin_temperature;
  json["theory"] = theory_json(scene);
  if (measured.profile) json["profile"] = profile_json(*measured.profile);
  if (measured.compartments) {
    json["compartments"]["share_left_series"] = measured.compartments->share_left_series;
    json["compartments"]["share_left_distribution"] =
        distribution_json(measured.compartments->distribution);
    if (measured.piston) {
      json["piston"]["position_series"] = measured.compartments->position_series;
    }
  }
  for (const ResultTable& table : measured.tables()) add_table(json, table);
  if (measured.residuals) json["balance"] = balance_json(*measured.residuals);
  json["checks"] = {{"deepest_overlap", simulation.checks().deepest_overlap},
                    {"clock_steps_back", simulation.checks().clock_steps_back}};
  if (averaged) json["checks"]["temperature_drift"] = measured.temperature.drift;
  if (elasticises) {
    const double collisions = std::max<double>(1.0, static_cast<double>(measured.pair_collisions));
    json["checks"]["elasticised_share"] = static_cast<double>(measured.elasticised) / collisions;
  }
  if (measured.undissipated_share) {
    json["checks"]["undissipated_share"] = *measured.undissipated_share;
  }
  const double collisions = static_cast<double>(performance.collisions);
  json["performance"] = {
      {"cpu_seconds", performance.cpu_seconds},
      {"wall_seconds", performance.wall_seconds},
      {"collisions_per_second",
       performance.cpu_seconds > 0.0 ? collisions / performance.cpu_seconds : 0.0},
      {"peak_memory_bytes", performance.peak_memory_bytes},
      {"tiles", performance.tiles}};
  return json;
}

template Json result_json(const Scene&, std::uint64_t, const Simulation<2>&, const Measured&,
                          const Performance&);
template Json result_json(const Scene&, std::uint64_t, const Simulation<3>&, const Measured&,
                          const Performance&);

// Text between the brackets of an object or a list, one element per line.
template <class Element>
static std::string lines(const Json& json, std::size_t depth, const Element& element) {
  const std::string indent(depth, ' ');
  std::string text;
  for (const auto& [key, value] : json.items()) {
    text += (text.empty() ? "\n " : ",\n ") + indent + element(key, value);
  }
  return text + '\n' + indent;
}

static std::string text_at(const Json& json, std::size_t depth) {
  if (json.is_object() && !json.empty()) {
    return '{' +
           lines(json, depth,
                 [&](const std::string& key, const Json& value) {
                   return Json(key).dump() + ": " + text_at(value, depth + 1);
                 }) +
           '}';
  }
  if (json.is_array() && std::ranges::any_of(json, &Json::is_structured)) {
    return '[' +
           lines(json, depth,
                 [&](const std::string&, const Json& value) { return text_at(value, depth + 1); }) +
           ']';
  }
  return json.dump();
}

std::string json_text(const Json& json) {
  return text_at(json, 0);
}

}  // namespace clatter
