#include "app/plots/species_theory.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "app/results/mixture_theory_json.h"

namespace clatter {

SpeciesTheory species_theory(const Scene& scene) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> none(scene.species.size(), kNone);
  SpeciesTheory theory{none, !scene.bulk_drive, none, none};
  const double start = theory.relative ? scene.particles.start.temperature : 1.0;
  const nlohmann::ordered_json json = mixture_theory_json(scene);
  for (const auto& one : json.value("species", nlohmann::ordered_json::array())) {
    const auto number = find_species(scene.species, one.at("name").get<std::string>()).value();
    theory.temperatures[number] =
        one.value("temperature_ratio", one.value("temperature", kNone) / start);
    theory.frictions[number] = one.value("friction", kNone);
    theory.diffusions[number] = one.value("diffusion", kNone);
  }
  return theory;
}

}  // namespace clatter
