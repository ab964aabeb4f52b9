#include "engine/scene/species.h"

#include "engine/physics/elementary.h"

namespace clatter {

double Species::quantile(double share) const {
  if (!polydispersity) return diameter;
  const double width = polydispersity->width;
  switch (polydispersity->kind) {
    case Spread::Uniform:
      return diameter * (1.0 + width * (2.0 * share - 1.0));
    case Spread::Gaussian:
      return diameter * (1.0 + width * cut_normal_quantile(share));
    case Spread::Lognormal:
      break;
  }
  const double variance = natural_log(1.0 + width * width);
  return diameter * exponential(std::sqrt(variance) * cut_normal_quantile(share) - 0.5 * variance);
}

double Species::mean_power(int power) const {
  constexpr int kQuantiles = 1000;
  const int of = polydispersity ? std::clamp(count, 1, kQuantiles) : 1;
  double sum = 0.0;
  for (int number = 0; number < of; ++number) {
    double product = 1.0;
    for (int k = 0; k < power; ++k) product *= diameter_of(number, of);
    sum += product;
  }
  return sum / of;
}

bool is_species_name(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  const bool names_error = name == "error" || name.ends_with("_error");
  return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, allowed) &&
         !names_error;
}

int count_of(const std::vector<Species>& species) {
  int count = 0;
  for (const Species& one : species) count += one.count;
  return count;
}

std::vector<std::string> names_of(const std::vector<Species>& species) {
  std::vector<std::string> names;
  for (const Species& one : species) names.push_back(one.name);
  return names;
}

std::optional<std::size_t> find_species(const std::vector<Species>& species,
                                        std::string_view name) {
  const auto found = std::ranges::find(species, name, &Species::name);
  if (found == species.end()) return std::nullopt;
  return static_cast<std::size_t>(found - species.begin());
}

Roughness with_differences(const Roughness& roughness, const Roughness& differences) {
  Roughness result = roughness;
  if (differences.friction) result.friction = differences.friction;
  if (differences.tangential_restitution) {
    result.tangential_restitution = differences.tangential_restitution;
  }
  return result;
}

Wall wall_of_species(const Wall& wall, const SpeciesWall& differences) {
  Wall result = wall;
  result.restitution = differences.restitution.value_or(wall.restitution);
  result.roughness = with_differences(wall.roughness, differences.roughness);
  result.drive_speed = differences.drive_speed.value_or(wall.drive_speed);
  result.temperature = differences.temperature.value_or(wall.temperature);
  return result;
}

}  // namespace clatter
