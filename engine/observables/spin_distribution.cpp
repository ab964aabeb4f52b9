#include "engine/observables/spin_distribution.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/observables/histogram.h"
#include "engine/scene/enum_names.h"

namespace clatter {

namespace {

// Layout of the sums over particles and samples.
struct SpinSums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kFourth = 1;   // of the components, over all components
  static constexpr std::size_t kAngles = 2;   // spheres with an angle
  static constexpr std::size_t kCosine = 3;   // of its squared cosine
  static constexpr std::size_t kCosines = 4;  // bins of its cosine
  static constexpr std::size_t kCosineBins = 50;
  static constexpr std::size_t kBins = kCosines + kCosineBins;  // of each component in turn
};

// Components of a spin.
template <int D>
constexpr int kComponents = D == 2 ? 1 : 3;

// Spins of a mixture times the root of the moment of inertia. All have the same distribution in
// equilibrium.
template <int D>
void weigh(std::vector<Spin<D>>& spins, const std::vector<Grain>& grains) {
  for (std::size_t i = 0; i < grains.size(); ++i) {
    spins[i] *= std::sqrt(grains[i].moment_of_inertia());
  }
}

// Velocity of the centre of mass.
template <int D>
Vec<D> mean_velocity(const State<D>& state) {
  Vec<D> momentum = Vec<D>::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < state.velocities.size(); ++i) {
    const double m = state.grains.empty() ? 1.0 : state.grains[i].mass;
    mass += m;
    momentum += m * state.velocities[i];
  }
  return momentum / mass;
}

}  // namespace

template <int D>
std::size_t SpinDistribution<D>::size() const {
  return SpinSums::kBins + static_cast<std::size_t>(kComponents<D> * settings_.bins);
}

template <int D>
std::size_t SpinDistribution<D>::mean_size() const {
  return SpinSums::kCosines;
}

template <int D>
void SpinDistribution<D>::sample() {
  const State<D> state = simulation_.state();
  const auto components = kComponents<D> * static_cast<double>(state.spins.size());
  double squares = 0.0;
  std::vector<Spin<D>> spins = state.spins;
  weigh<D>(spins, state.grains);
  for (const Spin<D>& spin : spins) squares += spin.squaredNorm();
  const double deviation = std::sqrt(squares / components);
  if (!std::isnormal(deviation)) return;
  const double per_bin = settings_.bins / (2.0 * settings_.range);
  std::vector<double>& sums = sums_.values;
  for (const Spin<D>& spin : spins) {
    const Spin<D> scaled = spin / deviation;
    for (int axis = 0; axis < kComponents<D>; ++axis) {
      // With n components, their sum of squares is n: a uniform distribution has the mean
      // 3 n/(n + 2).
      sums[SpinSums::kFourth] += std::pow(scaled[axis], 4) * (components + 2.0) / components;
      const double bin = (scaled[axis] + settings_.range) * per_bin;
      if (!(bin >= 0.0 && bin < settings_.bins)) continue;
      sums[SpinSums::kBins + static_cast<std::size_t>(axis * settings_.bins) +
           static_cast<std::size_t>(bin)] += 1.0;
    }
  }
  sums[SpinSums::kCount] += static_cast<double>(state.spins.size());
  if constexpr (D == 3) {
    const Vec<D> mean = mean_velocity(state);
    for (std::size_t i = 0; i < state.spins.size(); ++i) {
      const Vec<D> velocity = state.velocities[i] - mean;
      const double sizes = velocity.norm() * state.spins[i].norm();
      if (!std::isnormal(sizes)) continue;
      const double cosine = std::min(1.0, std::fabs(velocity.dot(state.spins[i])) / sizes);
      const auto bin = static_cast<std::size_t>(cosine * double{SpinSums::kCosineBins});
      sums[SpinSums::kAngles] += 1.0;
      sums[SpinSums::kCosine] += cosine * cosine;
      sums[SpinSums::kCosines + std::min(bin, SpinSums::kCosineBins - 1)] += 1.0;
    }
  }
}

template <int D>
ObservableResult SpinDistribution<D>::result(const ObservableParts& parts) const {
  ResultTable table{"spin_distribution.components", {{"low", "1", {}}, {"high", "1", {}}}};
  const double width = 2.0 * settings_.range / settings_.bins;
  for (int bin = 0; bin < settings_.bins; ++bin) {
    table.columns[0].values.push_back(-settings_.range + bin * width);
    table.columns[1].values.push_back(-settings_.range + (bin + 1) * width);
  }
  for (int axis = 0; axis < kComponents<D>; ++axis) {
    TableColumn column{
        D == 2 ? "density" : std::string(kAxes[static_cast<std::size_t>(axis)].name), "1", {}};
    for (int bin = 0; bin < settings_.bins; ++bin) {
      append(column,
             ratio_of(parts.coarse,
                      SpinSums::kBins + static_cast<std::size_t>(axis * settings_.bins + bin),
                      SpinSums::kCount, width));
    }
    table.columns.push_back(std::move(column));
  }
  ObservableResult result{
      {std::move(table)},
      {{"spin_distribution.kurtosis",
        ratio_of(parts.fine, SpinSums::kFourth, SpinSums::kCount, kComponents<D>)}}};
  if constexpr (D == 3) {
    result.tables.push_back(linear_histogram("spin_distribution.cosine", "1", parts.coarse,
                                             SpinSums::kCosines, SpinSums::kCosineBins, 0.0, 1.0,
                                             SpinSums::kAngles));
    result.means.emplace_back("spin_distribution.mean_squared_cosine",
                              ratio_of(parts.fine, SpinSums::kCosine, SpinSums::kAngles));
  }
  return result;
}

template class SpinDistribution<2>;
template class SpinDistribution<3>;

}  // namespace clatter
