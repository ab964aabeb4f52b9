#include "app/results/mixture_theory_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace clatter {

using Json = nlohmann::ordered_json;

MixtureGas mixture_gas(const Scene& scene) {
  constexpr int kClasses = 16;  // of a species of unequal diameters
  MixtureGas gas;
  gas.dimension = scene.dimension();
  gas.volume = scene.box.prod();
  gas.species = scene.species.size();
  for (std::size_t s = 0; s < gas.species; ++s) {
    const Species& one = scene.species[s];
    const int classes = one.polydispersity ? std::min(one.count, kClasses) : std::min(one.count, 1);
    for (int k = 0; k < classes; ++k) {
      const Grain grain = scene.grain(s, k, classes);
      gas.components.push_back({.species = s,
                                .count = static_cast<double>(one.count) / classes,
                                .diameter = 2.0 * grain.radius,
                                .mass = grain.mass,
                                .inertia = grain.inertia});
    }
    for (std::size_t t = 0; t < gas.species; ++t) {
      const PairLaw law = scene.pair_law(s, t);
      const double beta =
          law.roughness.any() ? law.roughness.tangential_restitution_in_force() : -1.0;
      gas.contacts.push_back({law.restitution, beta});
    }
  }
  return gas;
}

namespace {

bool can_collide(const Scene& scene, std::size_t a, std::size_t b) {
  if (scene.species.empty()) return scene.particles.count > 1;
  return std::min(scene.species[a].count, scene.species[b].count) >= (a == b ? 2 : 1);
}

// Whether test(law) holds for some pair of species that can collide.
template <class Test>
bool any_pair(const Scene& scene, const Test& test) {
  const std::size_t species = std::max<std::size_t>(scene.species.size(), 1);
  for (std::size_t a = 0; a < species; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      if (can_collide(scene, a, b) && test(scene.pair_law(a, b))) return true;
    }
  }
  return false;
}

// Adds a number of each species that has particles.
void add_to_species(Json& json, const Scene& scene, const MixtureGas& gas, const char* key,
                    const std::vector<double>& of_components) {
  std::size_t place = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    if (scene.species[s].count == 0) continue;
    json["species"][place++][key] = gas.mean_of(s, of_components);
  }
}

// Adds the spin temperatures of the species whose spins collisions change.
void add_spins(Json& json, const MixtureGas& gas, const char* key,
               const MixtureTemperatures& temperatures) {
  for (std::size_t c = 0, place = 0; c < gas.components.size(); ++c) {
    const std::size_t species = gas.components[c].species;
    if (c > 0 && gas.components[c - 1].species == species) continue;
    Json& one = json["species"][place++];
    if (gas.spins(c)) one[key] = gas.mean_of(species, temperatures.rotational);
  }
}

// Adds a number of each pair of species that can collide, by their numbers.
template <class Value>
void add_to_pairs(Json& json, const Scene& scene, const char* key, const Value& value) {
  std::size_t place = 0;
  for (std::size_t b = 0; b < scene.species.size(); ++b) {
    for (std::size_t a = 0; a <= b; ++a) {
      if (!can_collide(scene, a, b)) continue;
      Json& pair = json["pairs"][place++];
      if (!pair.contains("species")) {
        pair["species"] = Json::array({scene.species[a].name, scene.species[b].name});
      }
      pair[key] = value(a, b);
    }
  }
}

void add_names(Json& json, const Scene& scene) {
  for (const Species& one : scene.species) {
    if (one.count > 0) json["species"].push_back(Json{{"name", one.name}});
  }
}

void add_rates(Json& json, const Scene& scene, const MixtureGas& gas,
               const MixtureTemperatures& temperatures) {
  add_to_pairs(json, scene, "collision_rate",
               [&](std::size_t a, std::size_t b) { return gas.pair_rate(a, b, temperatures); });
}

// Friction and diffusion of species of one diameter, in gases without spins (theory 12.22-12.23).
void add_diffusion(Json& json, const Scene& scene, const MixtureGas& gas,
                   const MixtureTemperatures& in_collisions,
                   const std::vector<double>& temperatures) {
  if (scene.spins()) return;
  for (std::size_t c = 0; c < gas.components.size(); ++c) {
    const MixtureComponent& one = gas.components[c];
    const std::string& name = scene.species[one.species].name;
    if (one.count != gas.count_of(one.species)) continue;
    Json& species = *std::ranges::find_if(
        json["species"], [&](const Json& entry) { return entry.at("name") == name; });
    const double friction = gas.friction(c, in_collisions);
    if (!(friction > 0.0)) continue;
    species["friction"] = friction;
    species["diffusion"] = temperatures[c] / (one.mass * friction);
  }
}

// (theory 12.15): relative velocities have the variances of the temperature T N/(N - 1).
void add_elastic(Json& json, const Scene& scene, const MixtureGas& gas) {
  const double T = scene.particles.start.temperature, count = gas.count();
  add_names(json, scene);
  const std::vector<double> temperatures = gas.elastic_temperatures(T);
  const MixtureTemperatures relative = gas.equal(T * count / (count - 1.0));
  add_to_species(json, scene, gas, "temperature", temperatures);
  json["compressibility"] = gas.compressibility();
  add_rates(json, scene, gas, relative);
  add_diffusion(json, scene, gas, relative, temperatures);
}

void add_cooling(Json& json, const Scene& scene, const MixtureGas& gas) {
  const auto cooling = gas.cooling();
  if (!cooling) return;
  add_names(json, scene);
  add_to_species(json, scene, gas, "temperature_ratio", cooling->ratios.translational);
  add_spins(json, gas, "spin_temperature_ratio", cooling->ratios);
  json["compressibility"] = gas.compressibility(cooling->ratios);
  json["haff_rate"] = -0.5 * cooling->rate * std::sqrt(scene.particles.start.temperature);
}

// H becomes (2/D) H of T_s, and the kicks of spins become I s_w^2 / dt of R_s.
void add_driven(Json& json, const Scene& scene, const MixtureGas& gas) {
  const BulkDrive& drive = *scene.bulk_drive;
  std::vector<double> speeds;
  for (const MixtureComponent& one : gas.components)
    speeds.push_back(drive.kick_speed_of(one.mass));
  const std::vector<double> powers = gas.kick_powers(speeds, drive.interval);
  add_names(json, scene);
  add_to_species(json, scene, gas, "bulk_drive_power", powers);
  if (!dissipates(scene)) return;
  MixtureTemperatures heating = gas.equal(0.0);
  for (std::size_t s = 0; s < gas.components.size(); ++s) {
    const MixtureComponent& one = gas.components[s];
    const double spin_inertia = 0.25 * one.inertia * one.mass * one.diameter * one.diameter;
    heating.translational[s] = 2.0 / gas.dimension * powers[s];
    if (scene.spins()) {
      heating.rotational[s] = spin_inertia * drive.kick_spin * drive.kick_spin / drive.interval;
    }
  }
  const auto driven = gas.driven(heating);
  if (!driven) return;
  json["temperature_driven"] = gas.mean(driven->translational);
  add_to_species(json, scene, gas, "temperature", driven->translational);
  add_spins(json, gas, "spin_temperature", *driven);
  json["compressibility"] = gas.compressibility(*driven);
  add_rates(json, scene, gas, *driven);
  add_diffusion(json, scene, gas, *driven, driven->translational);
}

}  // namespace

bool dissipates(const Scene& scene) {
  return any_pair(scene, [](const PairLaw& law) { return law.dissipates(); });
}

Json mixture_theory_json(const Scene& scene) {
  Json json = Json::object();
  const MixtureGas gas = mixture_gas(scene);
  if (gas.components.empty()) return json;
  add_to_pairs(json, scene, "chi", [&](std::size_t a, std::size_t b) {
    return gas.contact_correlation(scene.species[a].diameter, scene.species[b].diameter);
  });
  const bool walled = std::ranges::any_of(scene.walls, [](const auto& wall) { return !!wall; });
  // Friction makes beta depend on the collision.
  const bool rubs = any_pair(scene, [](const PairLaw& law) {
    return law.roughness.any() && !std::isinf(law.roughness.friction_in_force());
  });
  if (walled || scene.gravity || scene.shear_rate || gas.count() < 2.0 || rubs) return json;
  const bool kicked =
      scene.bulk_drive && (scene.bulk_drive->kick_speed > 0.0 || scene.bulk_drive->kick_spin > 0.0);
  if (kicked) {
    add_driven(json, scene, gas);
  } else if (dissipates(scene)) {
    add_cooling(json, scene, gas);
  } else if (!scene.spins()) {
    add_elastic(json, scene, gas);
  }
  return json;
}

}  // namespace clatter
