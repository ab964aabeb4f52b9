#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <variant>

#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/physics/lattice.h"
#include "engine/physics/theory.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene_checks.h"
#include "engine/scene/scene_document.h"
#include "engine/text.h"

namespace clatter {

/// Place of a key of an item of a list, or of the item.
static Place place_in(const toml::table& root, const char* list, std::size_t number,
                      std::string_view key, const std::string& file) {
  const toml::node& item = *root[list][number].node();
  const Place found = item.is_table() ? place_of(*item.as_table(), key, file) : Place{file};
  return found.line > 0 || from_override(found) ? found : place_of(item, file);
}

/// Throws unless all species have different names that can be parts of keys.
static void check_names(const SceneInput& input, const toml::table& root, const std::string& file) {
  std::set<std::string> seen;
  for (std::size_t k = 0; k < input.species.size(); ++k) {
    const std::string& name = input.species[k].species.name;
    const Place place = place_in(root, "species", k, "name", file);
    if (!is_species_name(name)) {
      throw UserError(place, in_quotes(name) + " cannot be the name of a species",
                      "use up to 40 letters, digits, _ and -, without \"error\" as the last word");
    }
    if (!seen.insert(name).second) {
      throw UserError(place, "a second species has the name " + in_quotes(name),
                      "give each species a name of its own");
    }
  }
}

static void check_spreads(const SceneInput& input, const toml::table& root,
                          const std::string& file) {
  for (std::size_t k = 0; k < input.species.size(); ++k) {
    const Species& species = input.species[k].species;
    if (!species.polydispersity) continue;
    const Place place = place_in(root, "species", k, "polydispersity.width", file);
    const double width = species.polydispersity->width;
    const bool gaussian = species.polydispersity->kind == Spread::Gaussian;
    const double most = gaussian ? kMaxGaussianWidth : kMaxUniformWidth;
    if (width > most) {
      throw UserError(place, "at a width of " + number_text(width) + " diameters reach down to 0",
                      "choose a width of at most " + number_text(most));
    }
    const double smallest = species.smallest_diameter(), largest = species.largest_diameter();
    if (smallest < kMinDiameter || largest > kMaxDiameter) {
      throw UserError(
          place,
          "the diameters reach from " + number_text(smallest) + " to " + number_text(largest),
          "choose a smaller width, so that they are between " + number_text(kMinDiameter) +
              " and " + number_text(kMaxDiameter));
    }
  }
}

/// Throws if a mass is too large or too small, because the density sets it.
static void check_masses(const SceneInput& input, const toml::table& root,
                         const std::string& file) {
  for (std::size_t k = 0; k < input.species.size(); ++k) {
    const double mass = input.species[k].species.mass_in(input.scene.dimension());
    if (mass >= kMinMass && mass <= kMaxMass) continue;
    throw UserError(place_in(root, "species", k, "diameter", file),
                    "a particle would have a mass of " + number_text(mass),
                    "give 'mass' or 'density', so that it is between " + number_text(kMinMass) +
                        " and " + number_text(kMaxMass));
  }
}

static void check_species_pairs(const SceneInput& input, const toml::table& root,
                                const std::string& file) {
  const Scene& scene = input.scene;
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
    const Place place = place_in(root, "pair", k, "species", file);
    std::array<std::size_t, 2> numbers{};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string& name = scene.pairs[k].species[i];
      const auto number = find_species(scene.species, name);
      if (!number) refuse_species(place, name, input.species_names);
      numbers[i] = *number;
    }
    if (seen.insert(std::minmax(numbers[0], numbers[1])).second) continue;
    throw UserError(place,
                    "a second pair has the species " + in_quotes(scene.pairs[k].species[0]) +
                        " and " + in_quotes(scene.pairs[k].species[1]),
                    "put all keys of the two into one [[pair]]");
  }
}

/// Throws if a wall has a table of a species that the scene lacks.
static void check_species_walls(const SceneInput& input, const toml::table& root,
                                const std::string& file) {
  for (const char* const side : kSideNames) {
    const toml::table* tables = root["walls"][side]["species"].as_table();
    if (!tables) continue;
    for (const auto& [name, table] : *tables) {
      if (find_species(input.scene.species, name.str())) continue;
      const std::string path = std::string("walls.") + side + ".species." + std::string(name.str());
      refuse_species(place_of(root, path, file), name.str(), input.species_names);
    }
  }
}

void check_species_count(const toml::table& root, const std::string& file) {
  const toml::array* const species = root["species"].as_array();
  if (!species || species->size() <= kMaxSpecies) return;
  throw UserError(place_in(root, "species", kMaxSpecies, "name", file),
                  "there are " + std::to_string(species->size()) + " species",
                  "give at most " + std::to_string(kMaxSpecies) +
                      "; a species can have unequal diameters, by polydispersity");
}

void check_species(const SceneInput& input, const toml::table& root, const std::string& file) {
  check_names(input, root, file);
  check_spreads(input, root, file);
  check_masses(input, root, file);
  check_species_pairs(input, root, file);
  check_species_walls(input, root, file);
  if (input.species.empty()) return;
  const std::string packing(input.packing_key());
  for (const std::string& key : {std::string("particles.count"), packing}) {
    if (key == packing ? !input.packing_fraction : !input.count) continue;
    throw UserError(place_of(root, key, file), "'" + key + "' has no meaning beside [[species]]",
                    "give each species its own number");
  }
}

/// Volume of the particles of a species over that of the box, per particle.
static double fraction_of_one(const Scene& scene, const Species& species) {
  const int dimension = scene.dimension();
  return packing_fraction(dimension, species.mean_power(dimension) / scene.box.prod());
}

/// The number of particles that the keys of a species ask for; absent without a key.
static std::optional<double> asked_count(const SceneInput& input, std::size_t k) {
  const SpeciesInput& one = input.species[k];
  if (one.count) return *one.count;
  if (!one.packing_fraction) return std::nullopt;
  return std::round(*one.packing_fraction / fraction_of_one(input.scene, one.species));
}

void resolve_species(SceneInput& input, const toml::table& root, const std::string& file) {
  const std::string packing(input.packing_name());
  const bool from_file = input.scene.particles.start.layout == Layout::File;
  double sum = 0.0;
  for (std::size_t k = 0; k < input.species.size(); ++k) {
    const std::string name = in_quotes(input.species[k].species.name);
    const std::string advice = "give exactly one of 'count' and '" + packing + "'";
    if (input.species[k].count && input.species[k].packing_fraction) {
      throw UserError(place_in(root, "species", k, packing, file),
                      "the species " + name + " has both 'count' and '" + packing + "'", advice);
    }
    const auto count = asked_count(input, k);
    if (!count && !from_file) {
      throw UserError(place_in(root, "species", k, "name", file),
                      "the number of particles of the species " + name + " is missing", advice);
    }
    sum += count.value_or(0.0);
    if (sum > kMaxCount) {
      throw UserError(place_in(root, "species", k, "count", file),
                      "all species together have " + number_text(sum) + " particles",
                      "give at most " + number_text(kMaxCount));
    }
    input.scene.species[k].count = static_cast<int>(count.value_or(0.0));
  }
}

/// Throws if a file has another number of particles of a species than the keys.
template <int D>
static void count_grains(SceneInput& input, const State<D>& state, const toml::table& root,
                         const std::string& file) {
  std::vector<int> counts(input.species.size());
  for (const Grain& grain : state.grains) ++counts[grain.species];
  for (std::size_t k = 0; k < counts.size(); ++k) {
    Species& species = input.scene.species[k];
    const auto asked = asked_count(input, k);
    if (asked && *asked != counts[k]) {
      throw UserError(place_in(root, "species", k, "count", file),
                      "this asks for " + number_text(*asked) + " particles of the species " +
                          in_quotes(species.name) + ", and " + input.scene.particles.start.file +
                          " has " + std::to_string(counts[k]),
                      "remove the key, or choose the file that you mean");
    }
    species.count = counts[k];
  }
}

int resolve_mixture(SceneInput& input, const toml::table& root, const std::string& file) {
  Scene& scene = input.scene;
  if (scene.particles.start.layout == Layout::File) {
    std::visit([&](const auto& state) { count_grains(input, state, root, file); },
               scene.particles.start.state);
    return count_of(scene.species);
  }
  // The species with the largest volume is the one to reduce.
  std::size_t chosen = 0;
  double largest = -1.0;
  for (std::size_t k = 0; k < scene.species.size(); ++k) {
    const double volume = scene.species[k].count * fraction_of_one(scene, scene.species[k]);
    if (volume > largest) chosen = k;
    largest = std::max(largest, volume);
  }
  const double filled = scene.packing_fraction(), most = closest_packing(scene.dimension());
  if (filled > most) {
    const double rest = most - (filled - largest);
    const bool counted = input.species[chosen].count.has_value();
    const double fits = counted ? std::floor(rest / fraction_of_one(scene, scene.species[chosen]))
                                : std::floor(1e4 * rest) / 1e4;
    throw UserError(
        place_in(root, "species", chosen, counted ? "count" : input.packing_name(), file),
        "the species would fill " + number_text(std::round(1e4 * filled) / 1e4) +
            " of the box, more than the closest packing of equal particles",
        fits > 0.0 ? "give the species " + in_quotes(scene.species[chosen].name) + " at most " +
                         number_text(fits)
                   : "give fewer particles of each species, or a larger box");
  }
  const int count = count_of(scene.species);
  if (scene.particles.start.layout != Layout::Lattice) return count;
  const int capacity = with_dimension(scene.dimension(), [&](auto dimension) {
    return lattice_capacity(scene.start_room<dimension>());
  });
  if (count <= capacity) return count;
  throw UserError(place_of(root, "particles.start.layout", file),
                  "a lattice of the largest particles has " + std::to_string(capacity) +
                      " places for " + std::to_string(count) + " particles",
                  "give fewer particles, or set layout = \"random\"");
}

}  // namespace clatter
