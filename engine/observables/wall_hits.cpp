#include "engine/observables/wall_hits.h"

#include <cmath>
#include <string>

#include "engine/laws/wall.h"
#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums: those of the means of each wall, then the bins of each wall.
template <int D>
struct HitSums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kIncomingSpeed = 1;
  static constexpr std::size_t kEnergyGain = 2;
  static constexpr std::size_t kMeans = 3;
  static constexpr std::size_t kOfMeans = 2 * D * kMeans;
  static constexpr std::size_t kSize = kOfMeans + 2 * D * 2 * LogBins::kCount;

  static constexpr std::size_t means_of(int side) {
    return kMeans * static_cast<std::size_t>(side);
  }
  static constexpr std::size_t incoming_of(int side) {
    return kOfMeans + 2 * LogBins::kCount * static_cast<std::size_t>(side);
  }
  static constexpr std::size_t outgoing_of(int side) { return incoming_of(side) + LogBins::kCount; }
};

}  // namespace

template <int D>
std::size_t WallHits<D>::size() const {
  return HitSums<D>::kSize;
}

template <int D>
std::size_t WallHits<D>::mean_size() const {
  return HitSums<D>::kOfMeans;
}

template <int D>
void WallHits<D>::start() {
  Observable::start();
  observation_.emplace(simulation_, *this);
}

template <int D>
void WallHits<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  observation_.emplace(simulation_, *this);
}

template <int D>
void WallHits<D>::on_wall(const WallCollision<D>& collision) {
  if (!collision.at_wall()) return;
  const int axis = collision.side / 2;
  const ParticleChange<D>& change = collision.particle;
  const double before = change.velocity[axis];
  const double after = before + change.gain.momentum[axis] / change.grain.mass;
  const std::size_t first = HitSums<D>::means_of(collision.side);
  std::vector<double>& sums = sums_.values;
  sums[first + HitSums<D>::kCount] += 1.0;
  sums[first + HitSums<D>::kIncomingSpeed] += std::fabs(before);
  sums[first + HitSums<D>::kEnergyGain] += change.energy();
  sums[HitSums<D>::incoming_of(collision.side) + LogBins::of(std::fabs(before))] += 1.0;
  sums[HitSums<D>::outgoing_of(collision.side) + LogBins::of(std::fabs(after))] += 1.0;
}

template <int D>
ObservableResult WallHits<D>::result(const ObservableParts& parts) const {
  ObservableResult result;
  for (int side = 0; side < 2 * D; ++side) {
    if (!simulation_.model().walls[side]) continue;
    const std::string wall = std::string("wall_hits.") + kSideNames[side];
    const std::size_t first = HitSums<D>::means_of(side), hits = first + HitSums<D>::kCount;
    result.tables.push_back(log_histogram(wall + ".incoming", "a/t", parts.coarse,
                                          HitSums<D>::incoming_of(side), hits));
    result.tables.push_back(log_histogram(wall + ".outgoing", "a/t", parts.coarse,
                                          HitSums<D>::outgoing_of(side), hits));
    result.means.emplace_back(wall + ".mean_incoming_speed",
                              ratio_of(parts.fine, first + HitSums<D>::kIncomingSpeed, hits));
    result.means.emplace_back(wall + ".mean_energy_gain",
                              ratio_of(parts.fine, first + HitSums<D>::kEnergyGain, hits));
  }
  return result;
}

template class WallHits<2>;
template class WallHits<3>;

}  // namespace clatter
