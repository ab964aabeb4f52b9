#include "engine/measure/species_means.h"

#include <algorithm>

namespace clatter {

namespace {

template <int D>
using Windows = std::span<const SpeciesTotalsWindow<D>>;

template <int D, class Quantity>
Estimate estimate_of(Windows<D> windows, const Quantity& quantity) {
  std::vector<double> series;
  for (const SpeciesTotalsWindow<D>& window : windows) series.push_back(quantity(window));
  return mean_estimate(series);
}

template <int D>
bool has_walls(const Model<D>& model) {
  return std::ranges::any_of(model.walls, [](const auto& wall) { return wall.has_value(); });
}

// Of the particles of one species, each collision with its own kind counts twice.
template <int D>
std::optional<double> elasticised_share(Windows<D> windows, std::size_t species,
                                        std::size_t species_count) {
  double collisions = 0.0, elasticised = 0.0;
  for (const SpeciesTotalsWindow<D>& window : windows) {
    for (std::size_t other = 0; other < species_count; ++other) {
      const PairWindow& pair = window.pairs[pair_index(species, other)];
      const double times = other == species ? 2.0 : 1.0;
      collisions += times * pair.collisions;
      elasticised += times * pair.elasticised;
    }
  }
  if (collisions == 0.0) return std::nullopt;
  return elasticised / collisions;
}

template <int D>
SpeciesMeans means_of(Windows<D> windows, std::size_t s, const Model<D>& model) {
  const auto estimate = [&](const auto& quantity) {
    return estimate_of<D>(windows, [&](const auto& w) { return quantity(w.species[s], w); });
  };
  const auto occurred = [&](const auto& quantity) {
    return std::ranges::any_of(windows,
                               [&](const auto& w) { return quantity(w.species[s]) != 0.0; });
  };
  SpeciesMeans means;
  means.temperature = estimate([](const auto& one, const auto&) { return one.temperature.mean(); });
  means.mean_position.resize(D);
  for (int axis = 0; axis < D; ++axis) {
    means.axis_temperatures.push_back(
        estimate([&](const auto& one, const auto&) { return one.temperature[axis]; }));
    if (model.periodic(axis)) continue;
    means.mean_position[axis] =
        estimate([&](const auto& one, const auto&) { return one.position[axis]; });
  }
  if (model.spins) {
    means.spin_temperature =
        estimate([](const auto& one, const auto&) { return one.spin_temperature; });
  }
  if (has_walls(model)) {
    means.walls_in =
        estimate([](const auto& one, const auto& w) { return one.walls_in / w.duration; });
  }
  // A drive that has ended may have acted in some windows.
  if (model.bulk_drive || occurred([](const auto& one) { return one.bulk_in; })) {
    means.bulk_in =
        estimate([](const auto& one, const auto& w) { return one.bulk_in / w.duration; });
  }
  if (model.contact_time)
    means.elasticised_share = elasticised_share(windows, s, model.species->count());
  return means;
}

}  // namespace

template <int D>
std::vector<SpeciesMeans> species_means(Windows<D> windows, const Model<D>& model,
                                        const std::vector<std::size_t>& counts) {
  std::vector<SpeciesMeans> means(counts.size());
  for (std::size_t s = 0; s < counts.size(); ++s) {
    if (counts[s] > 0) means[s] = means_of(windows, s, model);
    means[s].name = model.species->name(s);
    means[s].count = counts[s];
  }
  return means;
}

template <int D>
std::vector<PairMeans> pair_means(Windows<D> windows, const Model<D>& model,
                                  const std::vector<std::size_t>& counts) {
  std::vector<PairMeans> means;
  for (std::size_t second = 0; second < counts.size(); ++second) {
    for (std::size_t first = 0; first <= second; ++first) {
      const std::size_t needed = first == second ? 2 : 1;
      if (counts[first] < needed || counts[second] < needed) continue;
      const std::size_t index = pair_index(first, second);
      PairMeans& pair = means.emplace_back();
      pair.species = {model.species->name(first), model.species->name(second)};
      pair.collision_rate = estimate_of<D>(
          windows, [&](const auto& w) { return w.pairs[index].collisions / w.duration; });
      pair.dissipated = estimate_of<D>(
          windows, [&](const auto& w) { return w.pairs[index].dissipated / w.duration; });
    }
  }
  return means;
}

template std::vector<SpeciesMeans> species_means(Windows<2>, const Model<2>&,
                                                 const std::vector<std::size_t>&);
template std::vector<SpeciesMeans> species_means(Windows<3>, const Model<3>&,
                                                 const std::vector<std::size_t>&);
template std::vector<PairMeans> pair_means(Windows<2>, const Model<2>&,
                                           const std::vector<std::size_t>&);
template std::vector<PairMeans> pair_means(Windows<3>, const Model<3>&,
                                           const std::vector<std::size_t>&);

}  // namespace clatter
