#include "engine/observables/clusters.h"

#include <algorithm>
#include <numeric>

#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"
#include "engine/observables/near_cells.h"

namespace clatter {

namespace {

// Layout of the sums over samples.
struct ClusterSums {
  static constexpr std::size_t kSamples = 0;
  static constexpr std::size_t kTime = 1;
  static constexpr std::size_t kNumber = 2;
  static constexpr std::size_t kLargest = 3;
  static constexpr std::size_t kMeanSize = 4;
  static constexpr std::size_t kBins = 5;
  static constexpr std::size_t kSize = kBins + CountBins::kCount;
};

}  // namespace

template <int D>
Clusters<D>::Clusters(const Simulation<D>& simulation, const ClusterSettings& settings)
    : simulation_(simulation),
      range_(settings.range),
      cells_(simulation.model(), simulation.particles().size(),
             settings.range * simulation.model().diameter) {}

template <int D>
std::size_t Clusters<D>::size() const {
  return ClusterSums::kSize;
}

template <int D>
std::size_t Clusters<D>::mean_size() const {
  return ClusterSums::kBins;
}

// The path to the root is halved.
template <int D>
std::size_t Clusters<D>::root_of(std::size_t particle) {
  while (parent_[particle] != particle) {
    parent_[particle] = parent_[parent_[particle]];
    particle = parent_[particle];
  }
  return particle;
}

template <int D>
void Clusters<D>::join(std::size_t first, std::size_t second) {
  first = root_of(first);
  second = root_of(second);
  if (first == second) return;
  if (sizes_[first] < sizes_[second]) std::swap(first, second);
  parent_[second] = first;
  sizes_[first] += sizes_[second];
}

template <int D>
void Clusters<D>::sample() {
  const std::size_t count = simulation_.particles().size();
  if (count == 0) return;
  parent_.resize(count);
  std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  sizes_.assign(count, 1);
  cells_.sort(simulation_.positions(), simulation_.domain());
  cells_.each_pair([&](std::uint32_t first, std::uint32_t second, const Vec<D>& apart) {
    if (are_near(simulation_, first, second, apart, range_)) join(first, second);
  });

  std::vector<double>& sums = sums_.values;
  std::size_t largest = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (parent_[i] != i) continue;
    const std::size_t size = sizes_[i];
    largest = std::max(largest, size);
    squares += static_cast<double>(size) * static_cast<double>(size);
    sums[ClusterSums::kNumber] += 1.0;
    sums[ClusterSums::kBins + CountBins::of(size)] += 1.0;
  }
  sums[ClusterSums::kSamples] += 1.0;
  sums[ClusterSums::kTime] += simulation_.time();
  sums[ClusterSums::kLargest] += static_cast<double>(largest);
  sums[ClusterSums::kMeanSize] += squares / static_cast<double>(count);
}

template <int D>
ObservableResult Clusters<D>::result(const ObservableParts& parts) const {
  const auto mean = [&](std::size_t sum) {
    return ratio_of(parts.fine, sum, ClusterSums::kSamples);
  };
  ResultTable growth{
      "clusters.growth",
      {{"time", "t", {}}, {"number", "1", {}}, {"largest", "1", {}}, {"mean_size", "1", {}}}};
  for (const ObservableSums& part : parts.coarse) {
    const double samples = part.values[ClusterSums::kSamples];
    if (samples == 0.0) continue;
    for (std::size_t column = 0; column < growth.columns.size(); ++column) {
      growth.columns[column].values.push_back(part.values[ClusterSums::kTime + column] / samples);
    }
  }
  return {
      {count_histogram("clusters.size", parts.coarse, ClusterSums::kBins, ClusterSums::kSamples),
       std::move(growth)},
      {{"clusters.number", mean(ClusterSums::kNumber)},
       {"clusters.largest", mean(ClusterSums::kLargest)},
       {"clusters.mean_size", mean(ClusterSums::kMeanSize)}}};
}

template class Clusters<2>;
template class Clusters<3>;

}  // namespace clatter
