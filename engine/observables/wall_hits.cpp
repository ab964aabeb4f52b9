#include "engine/observables/wall_hits.h"

#include <cmath>
#include <string>

#include "engine/observables/histogram.h"
#include "engine/observables/log_bins.h"
#include "engine/scene/wall.h"

namespace clatter {

namespace {

// Layout of the sums of each wall.
struct HitSums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kIncomingSpeed = 1;
  static constexpr std::size_t kEnergyGain = 2;
  static constexpr std::size_t kIncomingBins = 3;
  static constexpr std::size_t kOutgoingBins = kIncomingBins + LogBins::kCount;
  static constexpr std::size_t kPerWall = kOutgoingBins + LogBins::kCount;

  static constexpr std::size_t first_of(int side) {
    return kPerWall * static_cast<std::size_t>(side);
  }
};

}  // namespace

template <int D>
void WallHits<D>::start() {
  sums_.values.assign(HitSums::first_of(2 * D), 0.0);
  simulation_.add_observer(*this);
}

template <int D>
void WallHits<D>::restore(ArchiveReader& io) {
  io(sums_);
  io.require(sums_.values.size() == HitSums::first_of(2 * D));
  simulation_.add_observer(*this);
}

template <int D>
void WallHits<D>::on_wall(const WallCollision<D>& collision) {
  const int axis = collision.side / 2;
  const ParticleChange<D>& change = collision.particle;
  const double before = change.velocity[axis];
  const double after = before + change.gain.momentum[axis];
  const std::size_t first = HitSums::first_of(collision.side);
  std::vector<double>& sums = sums_.values;
  sums[first + HitSums::kCount] += 1.0;
  sums[first + HitSums::kIncomingSpeed] += std::fabs(before);
  sums[first + HitSums::kEnergyGain] += change.energy;
  sums[first + HitSums::kIncomingBins + LogBins::of(std::fabs(before))] += 1.0;
  sums[first + HitSums::kOutgoingBins + LogBins::of(std::fabs(after))] += 1.0;
}

template <int D>
ObservableSums WallHits<D>::close_window() {
  ObservableSums window = sums_;
  sums_.values.assign(HitSums::first_of(2 * D), 0.0);
  return window;
}

template <int D>
ObservableResult WallHits<D>::result(std::span<const ObservableSums> parts) const {
  ObservableResult result;
  for (int side = 0; side < 2 * D; ++side) {
    if (!simulation_.model().walls[side]) continue;
    const std::string wall = std::string("wall_hits.") + kSideNames[side];
    const std::size_t first = HitSums::first_of(side), hits = first + HitSums::kCount;
    result.tables.push_back(
        log_histogram(wall + ".incoming", "a/t", parts, first + HitSums::kIncomingBins, hits));
    result.tables.push_back(
        log_histogram(wall + ".outgoing", "a/t", parts, first + HitSums::kOutgoingBins, hits));
    result.means.emplace_back(wall + ".mean_incoming_speed",
                              ratio_of(parts, first + HitSums::kIncomingSpeed, hits));
    result.means.emplace_back(wall + ".mean_energy_gain",
                              ratio_of(parts, first + HitSums::kEnergyGain, hits));
  }
  return result;
}

template class WallHits<2>;
template class WallHits<3>;

}  // namespace clatter
