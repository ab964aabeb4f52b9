#include "engine/observables/lag_history.h"

#include <cmath>

namespace clatter {

template <int D>
LagHistory<D>::LagHistory(const TimeCorrelationSettings& settings) : lags_{0}, level_of_{0} {
  constexpr double kRounding = 1e-9;  // of the ratio of the settings
  const double longest = settings.longest / settings.interval * (1.0 + kRounding);
  const auto base = static_cast<std::uint64_t>(settings.lags);
  for (std::uint64_t spacing = 1; static_cast<double>(spacing) <= longest; spacing *= base) {
    // The first lag of a level is the last lag of the previous level.
    for (std::uint64_t k = levels_.empty() ? 1 : 2; k <= base; ++k) {
      if (static_cast<double>(k * spacing) > longest) break;
      lags_.push_back(k * spacing);
      level_of_.push_back(levels_.size());
    }
    levels_.push_back({spacing, std::vector<std::vector<Vec<D>>>(base)});
  }
}

template class LagHistory<2>;
template class LagHistory<3>;

}  // namespace clatter
