#include "engine/observables/collision_counts.h"

#include <algorithm>
#include <utility>

#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums over intervals.
struct CountSums {
  static constexpr std::size_t kParticles = 0;
  static constexpr std::size_t kNumber = 1;
  static constexpr std::size_t kSquare = 2;
  static constexpr std::size_t kPairs = 3;  // that collided
  static constexpr std::size_t kOfPairs = 4;
  static constexpr std::size_t kParticleBins = 5;
  static constexpr std::size_t kPairBins = kParticleBins + CountBins::kCount;
  static constexpr std::size_t kSize = kPairBins + CountBins::kCount;
};

constexpr std::size_t kMaxCounters = std::size_t{1} << 22;  // of pairs

// With this stride the counters of pairs are not too many.
std::size_t stride_of(std::size_t particles) {
  const std::size_t followed =
      std::max<std::size_t>(1, kMaxCounters / std::max<std::size_t>(1, particles));
  return std::max<std::size_t>(1, (particles + followed - 1) / followed);
}

std::size_t followed_of(std::size_t particles) {
  const std::size_t stride = stride_of(particles);
  return (particles + stride - 1) / stride;
}

}  // namespace

template <int D>
CollisionCounts<D>::CollisionCounts(Simulation<D>& simulation)
    : simulation_(simulation), count_(simulation.particles().size()), stride_(stride_of(count_)) {}

template <int D>
double CollisionCounts<D>::memory(double particles) {
  const auto count = static_cast<std::size_t>(particles);
  return sizeof(std::uint32_t) * (particles + static_cast<double>(followed_of(count)) * particles);
}

template <int D>
std::size_t CollisionCounts<D>::counters() const {
  return followed_of(count_) * count_;
}

template <int D>
std::size_t CollisionCounts<D>::size() const {
  return CountSums::kSize;
}

template <int D>
std::size_t CollisionCounts<D>::mean_size() const {
  return CountSums::kParticleBins;
}

template <int D>
void CollisionCounts<D>::start() {
  Observable::start();
  numbers_.assign(count_, 0);
  pairs_.assign(counters(), 0);
  collided_.clear();
  observation_.emplace(simulation_, *this);
}

template <int D>
void CollisionCounts<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  std::vector<std::uint32_t> counts;
  for (const std::uint64_t index : collided_) counts.push_back(pairs_[index]);
  io(numbers_, collided_, counts);
}

template <int D>
void CollisionCounts<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  std::vector<std::uint32_t> counts;
  io(numbers_, collided_, counts);
  io.require(numbers_.size() == count_ && counts.size() == collided_.size());
  pairs_.assign(counters(), 0);
  for (std::size_t k = 0; k < collided_.size(); ++k) {
    io.require(collided_[k] < pairs_.size());
    pairs_[collided_[k]] = counts[k];
  }
  observation_.emplace(simulation_, *this);
}

// The row of a pair is that of its first followed particle.
template <int D>
void CollisionCounts<D>::count_pair(std::size_t low, std::size_t high) {
  if (low % stride_ != 0) std::swap(low, high);
  if (low % stride_ != 0) return;
  const std::size_t index = low / stride_ * count_ + high;
  if (pairs_[index]++ == 0) collided_.push_back(index);
}

template <int D>
void CollisionCounts<D>::on_collision(const PairCollision<D>& collision) {
  const std::size_t first = collision.particles[0].particle;
  const std::size_t second = collision.particles[1].particle;
  ++numbers_[first];
  ++numbers_[second];
  count_pair(std::min(first, second), std::max(first, second));
}

template <int D>
void CollisionCounts<D>::sample() {
  std::vector<double>& sums = sums_.values;
  sums[CountSums::kParticles] += static_cast<double>(count_);
  for (std::uint32_t& number : numbers_) {
    sums[CountSums::kNumber] += number;
    sums[CountSums::kSquare] += static_cast<double>(number) * number;
    sums[CountSums::kParticleBins + CountBins::of(number)] += 1.0;
    number = 0;
  }
  sums[CountSums::kPairs] += static_cast<double>(collided_.size());
  for (const std::uint64_t index : collided_) {
    sums[CountSums::kOfPairs] += pairs_[index];
    sums[CountSums::kPairBins + CountBins::of(pairs_[index])] += 1.0;
    pairs_[index] = 0;
  }
  collided_.clear();
}

template <int D>
ObservableResult CollisionCounts<D>::result(const ObservableParts& parts) const {
  return {{count_histogram("collision_counts.particle", parts.coarse, CountSums::kParticleBins,
                           CountSums::kParticles),
           count_histogram("collision_counts.pair", parts.coarse, CountSums::kPairBins,
                           CountSums::kPairs)},
          {{"collision_counts.mean_number",
            ratio_of(parts.fine, CountSums::kNumber, CountSums::kParticles)},
           {"collision_counts.number_variance", variance_of(parts.fine, CountSums::kParticles)},
           {"collision_counts.mean_per_pair",
            ratio_of(parts.fine, CountSums::kOfPairs, CountSums::kPairs)}}};
}

template class CollisionCounts<2>;
template class CollisionCounts<3>;

}  // namespace clatter
