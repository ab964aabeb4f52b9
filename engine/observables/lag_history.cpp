#include "engine/observables/lag_history.h"

#include <algorithm>
#include <cmath>

namespace clatter {

template <int D>
LagHistory<D>::LagHistory(const TimeCorrelationSettings& settings) : lags_{0}, level_of_{0} {
  constexpr double kRounding = 1e-9;  // of the ratio of the settings
  const double longest = settings.longest / settings.interval * (1.0 + kRounding);
  const auto base = static_cast<std::uint64_t>(settings.lags);
  // The first lag of a level is the last lag of the previous level.
  for (std::uint64_t spacing = 1, first = 1; static_cast<double>(first * spacing) <= longest;
       spacing *= base, first = 2) {
    for (std::uint64_t k = first; k <= base; ++k) {
      if (static_cast<double>(k * spacing) > longest) break;
      lags_.push_back(k * spacing);
      level_of_.push_back(levels_.size());
    }
    levels_.push_back({spacing, std::vector<std::vector<Vec<D>>>(base)});
  }
}

template <int D>
std::size_t LagHistory<D>::capacity() const {
  std::size_t samples = 0;
  for (const Level& level : levels_) samples += level.samples.size();
  return samples;
}

template <int D>
bool LagHistory<D>::is_complete(std::size_t count) const {
  return std::ranges::all_of(levels_, [&](const Level& level) {
    const std::uint64_t taken = (samples_ + level.spacing - 1) / level.spacing;
    for (std::size_t k = 0; k < level.samples.size(); ++k) {
      if (level.samples[k].size() != (k < taken ? count : 0)) return false;
    }
    return true;
  });
}

template class LagHistory<2>;
template class LagHistory<3>;

}  // namespace clatter
