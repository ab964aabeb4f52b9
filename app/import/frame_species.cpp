#include "app/import/frame_species.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/scene/limits.h"
#include "engine/text.h"

namespace clatter {

namespace {

// Particles of a species, by their numbers in the frame.
using Members = std::vector<std::size_t>;

void require_positive(const ParticleFrame& frame, const std::vector<double>& numbers,
                      const std::string& quantities, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] > 0.0 && std::isfinite(numbers[i])) continue;
    refuse_particle(frame, i, path,
                    quantities + " must be positive, not " + number_text(numbers[i]),
                    "give positive " + quantities);
  }
}

// Whether numbers are equal, apart from rounding.
bool nearly_equal(double one, double other, double rounding) {
  return std::fabs(one - other) <= rounding * one;
}

bool all_equal(const std::vector<double>& numbers, double rounding) {
  return std::ranges::all_of(
      numbers, [&](double number) { return nearly_equal(numbers[0], number, rounding); });
}

// The first member whose number differs from that of the first one; absent: none.
std::optional<std::size_t> first_unequal(const std::vector<double>& numbers, const Members& members,
                                         double rounding) {
  for (const std::size_t i : members) {
    if (!nearly_equal(numbers[members.front()], numbers[i], rounding)) return i;
  }
  return std::nullopt;
}

// Throws unless the particles, which are alike, have the diameter 1 and one inertia.
void require_one_kind(ParticleFrame& frame, double scale, const std::filesystem::path& path) {
  if (!frame.inertias.empty()) {
    frame.inertia = frame.inertias.front();
    if (!all_equal(frame.inertias, 4.0 * frame.rounding)) {
      throw UserError({path.string()}, "particles of one kind have different moments of inertia",
                      "give them different types");
    }
  }
  if (frame.diameters.empty() || nearly_equal(frame.diameters[0], 1.0, frame.rounding)) return;
  refuse_particle(
      frame, 0, path, "the diameter is " + number_text(frame.diameters[0]) + " instead of 1",
      "divide all lengths by the diameter with --scale " + number_text(frame.diameters[0] * scale));
}

double volume_of(double diameter, int dimension) {
  return dimension == 2 ? diameter * diameter : diameter * diameter * diameter;
}

// The types of particles that have none: each diameter and mass is one, in the order of the
// particles. More than a scene can have are a single one.
void make_types(ParticleFrame& frame) {
  std::vector<std::pair<double, double>> kinds;  // diameter and mass
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    const std::pair kind(frame.diameters[i], frame.masses[i]);
    const auto known = std::ranges::find_if(kinds, [&](const auto& other) {
      return nearly_equal(other.first, kind.first, frame.rounding) &&
             nearly_equal(other.second, kind.second, frame.rounding);
    });
    frame.types.push_back(static_cast<int>(known - kinds.begin()) + 1);
    if (known == kinds.end()) kinds.push_back(kind);
    if (kinds.size() <= kMaxSpecies) continue;
    frame.types.assign(frame.positions.size(), 1);
    break;
  }
  name_types(frame);
}

// Gives the types names such as type1, unless all have different ones that are possible.
void make_names_possible(std::vector<std::string>& names) {
  const std::set<std::string> different(names.begin(), names.end());
  if (different.size() == names.size() && std::ranges::all_of(names, is_species_name)) return;
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = "type" + std::to_string(k + 1);
}

// The species of one type, whose particles it makes grains of.
class SpeciesOfType {
 public:
  SpeciesOfType(ParticleFrame& frame, const Members& members, const std::filesystem::path& path)
      : frame_(frame), members_(members), path_(path) {}

  void add() {
    Species species;
    species.name = frame_.names[static_cast<std::size_t>(frame_.types[first()])];
    species.count = static_cast<int>(members_.size());
    if (first_unequal(frame_.diameters, members_, frame_.rounding)) {
      set_unequal(species);
    } else {
      set_equal(species);
    }
    set_inertia(species);
    require_limits(species);
    for (const std::size_t i : members_) {
      frame_.grains[i] = {.radius = 0.5 * frame_.diameters[i],
                          .mass = frame_.masses[i],
                          .inertia = species.inertia.value_or(frame_.dimension == 2 ? 0.5 : 0.4),
                          .species = static_cast<std::uint32_t>(frame_.species.size())};
    }
    frame_.species.push_back(species);
  }

 private:
  std::size_t first() const { return members_.front(); }
  std::string which() const {
    return "particles of the type " +
           in_quotes(frame_.names[static_cast<std::size_t>(frame_.types[first()])]);
  }

  void set_equal(Species& species) {
    if (const auto other = first_unequal(frame_.masses, members_, frame_.rounding)) {
      refuse_particle(frame_, *other, path_,
                      which() + " have equal diameters, and the masses " +
                          number_text(frame_.masses[first()]) + " and " +
                          number_text(frame_.masses[*other]),
                      "give particles of different masses different types");
    }
    species.diameter = frame_.diameters[first()];
    species.mass = frame_.masses[first()];
    for (const std::size_t i : members_) {  // without the rounding of the file
      frame_.diameters[i] = species.diameter;
      frame_.masses[i] = *species.mass;
    }
  }

  // The distribution has the limits of the diameters. Its mass is that of the mean density.
  void set_unequal(Species& species) {
    double least = frame_.diameters[first()], most = least, density = 0.0;
    for (const std::size_t i : members_) {
      least = std::min(least, frame_.diameters[i]);
      most = std::max(most, frame_.diameters[i]);
      density += frame_.masses[i] / volume_of(frame_.diameters[i], frame_.dimension);
    }
    density /= static_cast<double>(members_.size());
    species.diameter = 0.5 * (least + most);
    species.mass = density * volume_of(species.diameter, frame_.dimension);
    species.polydispersity = {.kind = Spread::Uniform, .width = (most - least) / (most + least)};
  }

  void set_inertia(Species& species) {
    if (frame_.inertias.empty()) return;
    const double inertia = frame_.inertias[first()];
    if (const auto other = first_unequal(frame_.inertias, members_, 4.0 * frame_.rounding)) {
      refuse_particle(frame_, *other, path_,
                      which() + " have different moments of inertia for their masses and sizes",
                      "give them different types");
    }
    species.inertia = std::min(inertia, 1.0);  // apart from rounding
    if (inertia <= 1.0 + 4.0 * frame_.rounding) return;
    refuse_particle(frame_, first(), path_,
                    which() + " have a moment of inertia of more than m a^2/4",
                    "give at most that of a ring");
  }

  // Throws for a species that no scene can have.
  void require_limits(const Species& species) {
    for (const std::size_t i : members_) {
      const double diameter = frame_.diameters[i], mass = frame_.masses[i];
      if (!(diameter >= kMinDiameter && diameter <= kMaxDiameter)) {
        refuse_particle(frame_, i, path_, "the diameter is " + number_text(diameter),
                        "choose a unit of length with --scale, so that diameters are between " +
                            number_text(kMinDiameter) + " and " + number_text(kMaxDiameter));
      }
      if (!(mass >= kMinMass && mass <= kMaxMass)) {
        refuse_particle(
            frame_, i, path_, "the mass is " + number_text(mass),
            "give masses between " + number_text(kMinMass) + " and " + number_text(kMaxMass));
      }
    }
    if (!species.polydispersity) return;
    if (species.polydispersity->width <= kMaxUniformWidth) return;
    refuse_particle(frame_, first(), path_,
                    which() + " have too different diameters, of a width of more than " +
                        number_text(kMaxUniformWidth),
                    "give particles of different sizes different types");
  }

  ParticleFrame& frame_;
  const Members& members_;
  const std::filesystem::path& path_;
};

}  // namespace

void sort_into_species(ParticleFrame& frame, double scale, const std::filesystem::path& path) {
  require_positive(frame, frame.masses, "masses", path);
  require_positive(frame, frame.diameters, "diameters", path);
  const bool alike = frame.names.size() <= 1 && all_equal(frame.masses, frame.rounding) &&
                     all_equal(frame.diameters, frame.rounding);
  if (frame.positions.empty() || (alike && !frame.mixture)) {
    require_one_kind(frame, scale, path);
    return;
  }
  const std::size_t count = frame.positions.size();
  const bool sized = !frame.diameters.empty(), weighed = !frame.masses.empty();
  if (!sized) frame.diameters.assign(count, 1.0);
  for (std::size_t i = frame.masses.size(); i < count; ++i) {
    frame.masses.push_back(volume_of(frame.diameters[i], frame.dimension));
  }
  if (frame.types.empty()) make_types(frame);
  make_names_possible(frame.names);
  std::vector<Members> members(frame.names.size());
  for (std::size_t i = 0; i < count; ++i) {
    members[static_cast<std::size_t>(frame.types[i])].push_back(i);
  }
  std::erase_if(members, [](const Members& of_type) { return of_type.empty(); });
  if (members.size() > kMaxSpecies) {
    throw UserError({path.string()},
                    "the particles have " + std::to_string(members.size()) + " types",
                    "give at most " + std::to_string(kMaxSpecies));
  }
  frame.grains.resize(count);
  for (const Members& of_type : members) SpeciesOfType(frame, of_type, path).add();
  if (!sized) frame.diameters.clear();
  if (!weighed) frame.masses.clear();
}

std::string species_toml(const ParticleFrame& frame) {
  std::string text;
  for (const Species& species : frame.species) {
    text += fmt::format("[[species]]\nname = \"{}\"\ndiameter = {}\nmass = {}\n", species.name,
                        species.diameter, species.mass_in(frame.dimension));
    if (species.inertia) text += fmt::format("inertia = {}\n", *species.inertia);
    if (!species.polydispersity) continue;
    text += fmt::format("polydispersity = {{ kind = \"uniform\", width = {} }}\n",
                        species.polydispersity->width);
  }
  return text;
}

}  // namespace clatter
