#include "engine/observables/species_radial_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/observables/radial_distribution.h"

namespace clatter {

// Bins of distances beyond contact, in smallest diameters.
static constexpr double kContactWidth = 0.02;
static constexpr std::size_t kContactBins = 10;

template <int D>
static double smallest_diameter(const Simulation<D>& simulation) {
  double smallest = simulation.model().diameter;
  for (std::uint32_t i = 0; i < simulation.particles().size(); ++i) {
    smallest = std::min(smallest, 2.0 * simulation.grain(i).radius);
  }
  return smallest;
}

template <int D>
SpeciesRadialDistribution<D>::SpeciesRadialDistribution(const Simulation<D>& simulation,
                                                        const RadialDistributionSettings& settings)
    : simulation_(simulation),
      bins_(static_cast<std::size_t>(settings.bins)),
      low_(smallest_diameter(simulation)),
      range_(longest_distance(simulation.model(), settings.range)),
      width_((range_ - low_) / settings.bins),
      cells_(simulation.model(), simulation.particles().size(), range_) {
  add_pairs();
}

template <int D>
void SpeciesRadialDistribution<D>::add_pairs() {
  const SpeciesLaws<D>& laws = *simulation_.model().species;
  std::vector<double> counts(laws.count()), radii(laws.count()), largest(laws.count());
  for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
    const Grain& grain = simulation_.grain(i);
    counts[grain.species] += 1.0;
    radii[grain.species] += grain.radius;
    largest[grain.species] = std::max(largest[grain.species], grain.radius);
  }
  const std::vector<double> weights = contact_weights(kContactWidth, kContactBins);
  for (std::size_t t = 0; t < laws.count(); ++t) {
    for (std::size_t s = 0; s <= t; ++s) {
      Pair& pair = pairs_.emplace_back();
      pair.name = laws.name(s) + '+' + laws.name(t);
      pair.number = s == t ? 0.5 * counts[s] * (counts[s] - 1.0) : counts[s] * counts[t];
      const double reach = low_ * kContactWidth * kContactBins;
      if (!(pair.number > 0.0) || largest[s] + largest[t] + reach > range_) continue;
      const double contact = radii[s] / counts[s] + radii[t] / counts[t];
      for (std::size_t k = 0; k < weights.size(); ++k) {
        const double from = contact + low_ * kContactWidth * static_cast<double>(k);
        pair.contact_factors.push_back(
            weights[k] / expected_pairs(pair.number, from, from + low_ * kContactWidth));
      }
    }
  }
}

// Pairs of independent particles at distances between `low` and `high`.
template <int D>
double SpeciesRadialDistribution<D>::expected_pairs(double number, double low, double high) const {
  constexpr double kSphere = D == 2 ? 2.0 * std::numbers::pi : 4.0 * std::numbers::pi;
  return number * kSphere / D * (std::pow(high, D) - std::pow(low, D)) /
         simulation_.model().box.prod();
}

template <int D>
std::size_t SpeciesRadialDistribution<D>::size() const {
  return bins_of(1 + pairs_.size());
}

// Rounding may put a contact below the sum of the radii.
template <int D>
void SpeciesRadialDistribution<D>::sample() {
  std::vector<double>& sums = sums_.values;
  sums[0] += 1.0;
  cells_.sort(simulation_.positions(), simulation_.domain());
  cells_.each_pair([&](std::uint32_t first, std::uint32_t second, const Vec<D>& apart) {
    const Grain &a = simulation_.grain(first), &b = simulation_.grain(second);
    const std::size_t pair = pair_index(a.species, b.species);
    const double distance = apart.norm();
    const auto bin = static_cast<std::size_t>(std::max(0.0, (distance - low_) / width_));
    if (bin < bins_) {
      sums[bins_of(0) + bin] += 1.0;
      sums[bins_of(1 + pair) + bin] += 1.0;
    }
    const double beyond = std::max(0.0, distance - a.radius - b.radius) / (low_ * kContactWidth);
    const auto near = static_cast<std::size_t>(beyond);
    if (near < pairs_[pair].contact_factors.size()) {
      sums[1 + pair] += pairs_[pair].contact_factors[near];
    }
  });
}

template <int D>
ObservableResult SpeciesRadialDistribution<D>::result(const ObservableParts& parts) const {
  ResultTable table{"radial_distribution", {{"r", "a", {}}}};
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    table.columns[0].values.push_back(0.5 * (edge(bin) + edge(bin + 1)));
  }
  const auto add = [&](const std::string& name, std::size_t column, double number) {
    TableColumn& values = table.columns.emplace_back(TableColumn{name, "1", {}});
    for (std::size_t bin = 0; bin < bins_; ++bin) {
      append(values, ratio_of(parts.coarse, bins_of(column) + bin, 0,
                              expected_pairs(number, edge(bin), edge(bin + 1))));
    }
  };
  const auto count = static_cast<double>(simulation_.particles().size());
  add("g", 0, 0.5 * count * (count - 1.0));
  ObservableResult result;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    if (!(pairs_[pair].number > 0.0)) continue;
    add("g_" + pairs_[pair].name, 1 + pair, pairs_[pair].number);
    if (pairs_[pair].contact_factors.empty()) continue;
    result.means.emplace_back("radial_distribution.contact_" + pairs_[pair].name,
                              ratio_of(parts.fine, 1 + pair, 0));
  }
  result.tables.push_back(std::move(table));
  return result;
}

template class SpeciesRadialDistribution<2>;
template class SpeciesRadialDistribution<3>;

}  // namespace clatter
