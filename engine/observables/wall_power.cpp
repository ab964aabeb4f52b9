#include "engine/observables/wall_power.h"

#include <numeric>
#include <string>

#include "engine/laws/wall.h"
#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums: those of the means of each wall and of all walls, then their bins.
template <int D>
struct PowerSums {
  static constexpr std::size_t kSources = 2 * D + 1;  // the last one is the sum of all walls
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kPower = 1;
  static constexpr std::size_t kSquare = 2;
  static constexpr std::size_t kMeans = 3;
  static constexpr std::size_t kOfMeans = kSources * kMeans;
  static constexpr std::size_t kSize = kOfMeans + kSources * SignedLogBins::kCount;

  static constexpr std::size_t means_of(std::size_t source) { return kMeans * source; }
  static constexpr std::size_t bins_of(std::size_t source) {
    return kOfMeans + SignedLogBins::kCount * source;
  }
};

}  // namespace

template <int D>
std::size_t WallPower<D>::size() const {
  return PowerSums<D>::kSize;
}

template <int D>
std::size_t WallPower<D>::mean_size() const {
  return PowerSums<D>::kOfMeans;
}

template <int D>
void WallPower<D>::start() {
  Observable::start();
  energy_ = {};
  observation_.emplace(simulation_, *this);
}

template <int D>
void WallPower<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  io(energy_);
}

template <int D>
void WallPower<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  io(energy_);
  observation_.emplace(simulation_, *this);
}

template <int D>
void WallPower<D>::on_wall(const WallCollision<D>& collision) {
  if (!collision.at_wall()) return;
  energy_[static_cast<std::size_t>(collision.side)] += collision.particle.energy();
}

template <int D>
void WallPower<D>::sample() {
  const auto add = [&](std::size_t source, double energy) {
    const double power = energy / settings_.interval;
    double* const means = &sums_.values[PowerSums<D>::means_of(source)];
    means[PowerSums<D>::kCount] += 1.0;
    means[PowerSums<D>::kPower] += power;
    means[PowerSums<D>::kSquare] += power * power;
    sums_.values[PowerSums<D>::bins_of(source) + SignedLogBins::of(power)] += 1.0;
  };
  for (std::size_t side = 0; side < 2 * D; ++side) add(side, energy_[side]);
  add(2 * D, std::accumulate(energy_.begin(), energy_.end(), 0.0));
  energy_ = {};
}

template <int D>
ObservableResult WallPower<D>::result(const ObservableParts& parts) const {
  ObservableResult result;
  for (std::size_t source = 0; source < PowerSums<D>::kSources; ++source) {
    const bool total = source == 2 * D;
    if (!total && !simulation_.model().walls[source]) continue;
    const std::string name = std::string("wall_power.") + (total ? "total" : kSideNames[source]);
    const std::size_t first = PowerSums<D>::means_of(source);
    result.tables.push_back(signed_log_histogram(name, "m a^2/t^3", parts.coarse,
                                                 PowerSums<D>::bins_of(source), first));
    const Estimate mean =
        ratio_of(parts.fine, first + PowerSums<D>::kPower, first + PowerSums<D>::kCount);
    result.means.emplace_back(name + ".mean", mean);
    result.means.emplace_back(name + ".variance", variance_of(parts.fine, first));
  }
  return result;
}

template class WallPower<2>;
template class WallPower<3>;

}  // namespace clatter
