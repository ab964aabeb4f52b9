#pragma once

#include <cstdint>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/scene/observable_settings.h"
#include "engine/vec.h"

namespace clatter {

/// Earlier samples of one vector per particle, at lags that grow by powers. Level k keeps the
/// latest samples at the spacing lags^k, so that the memory grows with the logarithm of the longest
/// lag (Frenkel & Smit 2002, section 4.4.2).
template <int D>
class LagHistory {
 public:
  explicit LagHistory(const TimeCorrelationSettings& settings);

  /// The lags in units of the interval, in increasing order. The first is 0.
  const std::vector<std::uint64_t>& lags() const { return lags_; }
  /// Number of samples that are stored at most.
  std::size_t capacity() const;

  /// Adds the next sample [N]. Calls visit(index, earlier) for each lag whose earlier sample
  /// exists, with the index of the lag, lag 0 included.
  template <class Visit>
  void add(const std::vector<Vec<D>>& sample, const Visit& visit) {
    visit(std::size_t{0}, sample);
    for (std::size_t k = 1; k < lags_.size(); ++k) {
      const Level& level = levels_[level_of_[k]];
      if (samples_ % level.spacing != 0 || samples_ < lags_[k]) continue;
      const std::uint64_t number = (samples_ - lags_[k]) / level.spacing;
      visit(k, level.samples[number % level.samples.size()]);
    }
    for (Level& level : levels_) {
      if (samples_ % level.spacing != 0) continue;
      level.samples[samples_ / level.spacing % level.samples.size()] = sample;
    }
    ++samples_;
  }

  /// Whether all samples that later lags need are present, with `count` vectors each.
  bool is_complete(std::size_t count) const;

  /// Visits the members that a checkpoint keeps.
  template <class Archive>
  void visit(Archive& io) {
    io(samples_);
    for (Level& level : levels_) io(level.samples);
  }

 private:
  struct Level {
    std::uint64_t spacing;                     // of the samples, in intervals
    std::vector<std::vector<Vec<D>>> samples;  // [lags] ring of the latest
  };

  std::vector<std::uint64_t> lags_;
  std::vector<std::size_t> level_of_;  // [lags]
  std::vector<Level> levels_;
  std::uint64_t samples_ = 0;
};

extern template class LagHistory<2>;
extern template class LagHistory<3>;

}  // namespace clatter
