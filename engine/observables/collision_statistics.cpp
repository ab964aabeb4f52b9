#include "engine/observables/collision_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums.
struct CollisionSums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kImpactParameter = 1;
  static constexpr std::size_t kNormalSpeed = 2;
  static constexpr std::size_t kTangentialSpeed = 3;
  static constexpr std::size_t kEnergyLoss = 4;
  static constexpr std::size_t kDissipative = 5;  // collisions that dissipate
  static constexpr std::size_t kFrictional = 6;   // collisions with finite friction
  static constexpr std::size_t kSliding = 7;
  static constexpr std::size_t kRecollisions = 8;  // of two last partners
  static constexpr std::size_t kImpactBins = 9;
  static constexpr std::size_t kImpactBinCount = 50;
  static constexpr std::size_t kNormalBins = kImpactBins + kImpactBinCount;
  static constexpr std::size_t kTangentialBins = kNormalBins + LogBins::kCount;
  static constexpr std::size_t kLossBins = kTangentialBins + LogBins::kCount;
  static constexpr std::size_t kSize = kLossBins + LogBins::kCount;
};

// Kinetic energy of a particle before a collision.
template <int D>
double energy_before(const ParticleChange<D>& change) {
  return 0.5 * (change.grain.mass * change.velocity.squaredNorm() +
                change.grain.moment_of_inertia() * change.spin.squaredNorm());
}

// Energy that a collision dissipates. A difference by rounding is 0.
template <int D>
double dissipated(const PairCollision<D>& collision) {
  constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
  const auto& [first, second] = collision.particles;
  const double loss = -collision.energy();
  const double of_flow = collision.shear_rate * collision.separation[1] * first.gain.momentum[0];
  const double energy = energy_before(first) + energy_before(second) + std::fabs(of_flow);
  return collision.elasticised || loss < kRounding * energy ? 0.0 : loss;
}

// Whether the tangential impulse reaches the Coulomb limit, up to rounding.
template <int D>
bool slides(const Vec<D>& impulse, const Vec<D>& normal, double friction) {
  constexpr double kAtLimit = 1.0 - 1e-9;
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double along = impulse.dot(normal);
  const double across = (impulse - along * normal).norm();
  return std::fabs(along) > 0.0 && across >= (kAtLimit * friction - kRounding) * std::fabs(along);
}

}  // namespace

template <int D>
std::size_t CollisionStatistics<D>::size() const {
  return CollisionSums::kSize;
}

template <int D>
std::size_t CollisionStatistics<D>::mean_size() const {
  return CollisionSums::kImpactBins;
}

template <int D>
void CollisionStatistics<D>::start() {
  Observable::start();
  partners_.resize(simulation_.particles().size());
  std::iota(partners_.begin(), partners_.end(), 0u);
  observation_.emplace(simulation_, *this);
}

template <int D>
void CollisionStatistics<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  io(partners_);
}

template <int D>
void CollisionStatistics<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  io(partners_);
  io.require(partners_.size() == simulation_.particles().size());
  observation_.emplace(simulation_, *this);
}

template <int D>
void CollisionStatistics<D>::on_collision(const PairCollision<D>& collision) {
  const auto& [first, second] = collision.particles;
  const Vec<D> relative = collision.approach();
  const Vec<D> normal = collision.separation.normalized();
  // Grazing particles may recede by rounding.
  const double normal_speed = std::max(0.0, -relative.dot(normal));
  const double tangential_speed = (relative - relative.dot(normal) * normal).norm();
  const double speed = relative.norm();
  const double impact_parameter = speed > 0.0 ? tangential_speed / speed : 0.0;
  const double loss = dissipated(collision);
  std::vector<double>& sums = sums_.values;
  const auto bin =
      static_cast<std::size_t>(impact_parameter * double{CollisionSums::kImpactBinCount});
  sums[CollisionSums::kCount] += 1.0;
  sums[CollisionSums::kImpactParameter] += impact_parameter;
  sums[CollisionSums::kNormalSpeed] += normal_speed;
  sums[CollisionSums::kTangentialSpeed] += tangential_speed;
  sums[CollisionSums::kImpactBins + std::min(bin, CollisionSums::kImpactBinCount - 1)] += 1.0;
  sums[CollisionSums::kNormalBins + LogBins::of(normal_speed)] += 1.0;
  sums[CollisionSums::kTangentialBins + LogBins::of(tangential_speed)] += 1.0;
  if (loss > 0.0) {
    sums[CollisionSums::kEnergyLoss] += loss;
    sums[CollisionSums::kDissipative] += 1.0;
    sums[CollisionSums::kLossBins + LogBins::of(loss)] += 1.0;
  }
  if (partners_[first.particle] == second.particle &&
      partners_[second.particle] == first.particle) {
    sums[CollisionSums::kRecollisions] += 1.0;
  }
  partners_[first.particle] = second.particle;
  partners_[second.particle] = first.particle;
  const Roughness roughness =
      simulation_.model().pair(first.grain.species, second.grain.species).roughness;
  const double friction = roughness.friction_in_force();
  if (!roughness.any() || !std::isfinite(friction)) return;
  sums[CollisionSums::kFrictional] += 1.0;
  if (slides<D>(first.gain.momentum, normal, friction)) sums[CollisionSums::kSliding] += 1.0;
}

template <int D>
ObservableResult CollisionStatistics<D>::result(const ObservableParts& parts) const {
  const auto mean = [&](std::size_t sum) {
    return ratio_of(parts.fine, sum, CollisionSums::kCount);
  };
  // A law of collisions may have applied during a part of the run only.
  const auto occurred = [&](std::size_t sum) {
    return std::ranges::any_of(parts.fine,
                               [&](const ObservableSums& part) { return part.values[sum] > 0.0; });
  };
  ObservableResult result{
      {linear_histogram("collisions.impact_parameter", "a", parts.coarse,
                        CollisionSums::kImpactBins, CollisionSums::kImpactBinCount, 0.0, 1.0,
                        CollisionSums::kCount),
       log_histogram("collisions.normal_speed", "a/t", parts.coarse, CollisionSums::kNormalBins,
                     CollisionSums::kCount),
       log_histogram("collisions.tangential_speed", "a/t", parts.coarse,
                     CollisionSums::kTangentialBins, CollisionSums::kCount)},
      {{"collisions.mean_impact_parameter", mean(CollisionSums::kImpactParameter)},
       {"collisions.mean_normal_speed", mean(CollisionSums::kNormalSpeed)},
       {"collisions.mean_tangential_speed", mean(CollisionSums::kTangentialSpeed)},
       {"collisions.recollision_share", mean(CollisionSums::kRecollisions)}}};
  if (occurred(CollisionSums::kDissipative)) {
    result.tables.push_back(log_histogram("collisions.energy_loss", "m a^2/t^2", parts.coarse,
                                          CollisionSums::kLossBins, CollisionSums::kCount));
    result.means.emplace_back("collisions.mean_energy_loss", mean(CollisionSums::kEnergyLoss));
  }
  if (occurred(CollisionSums::kFrictional)) {
    result.means.emplace_back(
        "collisions.sliding_share",
        ratio_of(parts.fine, CollisionSums::kSliding, CollisionSums::kFrictional));
  }
  return result;
}

template class CollisionStatistics<2>;
template class CollisionStatistics<3>;

}  // namespace clatter
