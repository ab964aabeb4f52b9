#include "engine/observables/collision_statistics.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/observables/histogram.h"
#include "engine/observables/log_bins.h"

namespace clatter {

namespace {

// Layout of the sums.
struct CollisionSums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kImpactParameter = 1;
  static constexpr std::size_t kNormalSpeed = 2;
  static constexpr std::size_t kTangentialSpeed = 3;
  static constexpr std::size_t kEnergyLoss = 4;
  static constexpr std::size_t kSliding = 5;
  static constexpr std::size_t kImpactBins = 6;
  static constexpr std::size_t kImpactBinCount = 50;
  static constexpr std::size_t kNormalBins = kImpactBins + kImpactBinCount;
  static constexpr std::size_t kTangentialBins = kNormalBins + LogBins::kCount;
  static constexpr std::size_t kLossBins = kTangentialBins + LogBins::kCount;
  static constexpr std::size_t kSize = kLossBins + LogBins::kCount;
};

// The coefficient of friction between particles, if it is finite.
std::optional<double> finite_friction(const Roughness& roughness) {
  const double friction = roughness.friction_in_force();
  return roughness.any() && std::isfinite(friction) ? std::optional(friction) : std::nullopt;
}

}  // namespace

template <int D>
void CollisionStatistics<D>::start() {
  sums_.values.assign(CollisionSums::kSize, 0.0);
  simulation_.add_observer(*this);
}

template <int D>
void CollisionStatistics<D>::restore(ArchiveReader& io) {
  io(sums_);
  io.require(sums_.values.size() == CollisionSums::kSize);
  simulation_.add_observer(*this);
}

template <int D>
void CollisionStatistics<D>::on_collision(const PairCollision<D>& collision) {
  const auto& [first, second] = collision.particles;
  const Vec<D> relative = first.velocity - second.velocity;
  const Vec<D> normal = collision.separation.normalized();
  const double normal_speed = -relative.dot(normal);
  const double tangential_speed = (relative + normal_speed * normal).norm();
  const double impact_parameter = tangential_speed / relative.norm();
  const double loss = -(first.energy + second.energy);
  std::vector<double>& sums = sums_.values;
  const auto bin =
      static_cast<std::size_t>(impact_parameter * double{CollisionSums::kImpactBinCount});
  sums[CollisionSums::kCount] += 1.0;
  sums[CollisionSums::kImpactParameter] += impact_parameter;
  sums[CollisionSums::kNormalSpeed] += normal_speed;
  sums[CollisionSums::kTangentialSpeed] += tangential_speed;
  sums[CollisionSums::kEnergyLoss] += loss;
  sums[CollisionSums::kImpactBins + std::min(bin, CollisionSums::kImpactBinCount - 1)] += 1.0;
  sums[CollisionSums::kNormalBins + LogBins::of(normal_speed)] += 1.0;
  sums[CollisionSums::kTangentialBins + LogBins::of(tangential_speed)] += 1.0;
  if (loss > 0.0) sums[CollisionSums::kLossBins + LogBins::of(loss)] += 1.0;
  const std::optional<double> friction = finite_friction(simulation_.model().roughness);
  if (!friction) return;
  const double normal_impulse = std::fabs(first.gain.momentum.dot(normal));
  const double tangential_impulse =
      (first.gain.momentum - first.gain.momentum.dot(normal) * normal).norm();
  // The limit is reached up to the rounding of the impulse.
  constexpr double kAtLimit = 1.0 - 1e-9;
  if (tangential_impulse >= kAtLimit * *friction * normal_impulse)
    sums[CollisionSums::kSliding] += 1.0;
}

template <int D>
ObservableSums CollisionStatistics<D>::close_window() {
  ObservableSums window = sums_;
  sums_.values.assign(CollisionSums::kSize, 0.0);
  return window;
}

template <int D>
ObservableResult CollisionStatistics<D>::result(std::span<const ObservableSums> parts) const {
  const Model<D>& model = simulation_.model();
  const auto mean = [&](std::size_t sum) { return ratio_of(parts, sum, CollisionSums::kCount); };
  ObservableResult result{
      {linear_histogram("collisions.impact_parameter", "a", parts, CollisionSums::kImpactBins,
                        CollisionSums::kImpactBinCount, 0.0, 1.0, CollisionSums::kCount),
       log_histogram("collisions.normal_speed", "a/t", parts, CollisionSums::kNormalBins,
                     CollisionSums::kCount),
       log_histogram("collisions.tangential_speed", "a/t", parts, CollisionSums::kTangentialBins,
                     CollisionSums::kCount)},
      {{"collisions.mean_impact_parameter", mean(CollisionSums::kImpactParameter)},
       {"collisions.mean_normal_speed", mean(CollisionSums::kNormalSpeed)},
       {"collisions.mean_tangential_speed", mean(CollisionSums::kTangentialSpeed)}}};
  if (model.dissipates()) {
    result.tables.push_back(log_histogram("collisions.energy_loss", "m a^2/t^2", parts,
                                          CollisionSums::kLossBins, CollisionSums::kCount));
    result.means.emplace_back("collisions.mean_energy_loss", mean(CollisionSums::kEnergyLoss));
  }
  if (finite_friction(model.roughness)) {
    result.means.emplace_back("collisions.sliding_share", mean(CollisionSums::kSliding));
  }
  return result;
}

template class CollisionStatistics<2>;
template class CollisionStatistics<3>;

}  // namespace clatter
