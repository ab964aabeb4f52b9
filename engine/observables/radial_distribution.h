#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/laws/model.h"
#include "engine/observables/near_cells.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// Length of the region of centres along an axis: the period, or the distance between wall planes.
template <int D>
double room_of(const Model<D>& model, int axis) {
  return model.periodic(axis) ? model.box[axis]
                              : model.wall_plane(axis, 1) - model.wall_plane(axis, 0);
}

/// The range of distances, shortened to half the shortest period and to the shortest distance
/// between walls. Expected numbers of longer distances would need other terms.
template <int D>
double longest_distance(const Model<D>& model, double range) {
  for (int axis = 0; axis < D; ++axis) {
    range = std::min(range, (model.periodic(axis) ? 0.5 : 1.0) * room_of(model, axis));
  }
  return range;
}

/// Weights of the values of g in bins beyond contact, whose sum is the value at contact of the
/// parabola fitted to the bins within 0.2 diameters. Empty if these are too few. `bin_width` is in
/// diameters.
std::vector<double> contact_weights(double bin_width, std::size_t all_bins);

/// g(r) of all pairs (theory 11.6): the number of pairs at distance r, relative to independent
/// particles that are uniform in the region of centres. Edges of bins are exact to 1/1000 of a bin.
/// Table "radial_distribution"; the mean "radial_distribution.contact" is g at contact,
/// extrapolated from bins near it. It is absent if the bins are too wide for that.
template <int D>
class RadialDistribution final : public Observable {
 public:
  RadialDistribution(const Simulation<D>& simulation, const RadialDistributionSettings& settings);

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  void sample() override;
  ObservableSums close_window() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override { io(samples_, counts_); }
  void restore(ArchiveReader& io) override;

 private:
  // Pairs beyond the range are counted too, in further bins. One counter for all would be slower.
  static constexpr std::size_t kBinShare = 4;

  // Coordinates along each axis: [axis][entries of cells_]. Distances have the precision of Real.
  template <typename Real>
  using Coordinates = std::array<std::vector<Real>, D>;
  template <typename Real>
  void count(const Coordinates<Real>& coordinates);
  template <typename Real>
  [[gnu::always_inline]] inline void count_all(const Coordinates<Real>& coordinates);
#if defined(__x86_64__)
  template <typename Real>
  void count_all_avx2(const Coordinates<Real>& coordinates);
#endif
  double edge(std::size_t bin) const;
  double expected_share(double low, double high) const;

  const Simulation<D>& simulation_;
  std::size_t bins_;
  double range_;  // of distances
  double width_;  // of a bin
  NearCells<D> cells_;
  std::vector<double> expected_;         // [bins] pairs of independent particles
  std::vector<double> contact_weights_;  // of the values near contact; empty: too few bins
  std::vector<int> bins_of_pairs_;       // to be counted
  bool single_precision_;                // suffices for coordinates
  Coordinates<float> rounded_;           // empty unless single_precision_
  double samples_ = 0.0;
  std::vector<std::uint64_t> counts_;  // [kBinShare bins + 1] pairs; the last beyond all
};

extern template class RadialDistribution<2>;
extern template class RadialDistribution<3>;

}  // namespace clatter
