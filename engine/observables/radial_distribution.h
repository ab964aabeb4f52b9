#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// g(r) of all pairs (theory 11.6): the number of pairs at distance r, relative to independent
/// particles that are uniform in the region of centres. Table "radial_distribution"; the mean
/// "radial_distribution.contact" is g at contact, extrapolated from bins near it. It is absent if
/// the bins are too wide for that.
template <int D>
class RadialDistribution final : public Observable {
 public:
  RadialDistribution(const Simulation<D>& simulation, const RadialDistributionSettings& settings);

  void start() override;
  void sample() override;
  ObservableSums close_window() override;
  ObservableResult result(std::span<const ObservableSums> parts) const override;
  void save(ArchiveWriter& io) override { io(samples_, counts_); }
  void restore(ArchiveReader& io) override;

 private:
  // Pairs beyond the range are counted too, in further bins. One counter for all would be slower.
  static constexpr int kBinShare = 4;

  // Consecutive particles in the order of the cells, or consecutive cells.
  struct Range {
    std::size_t begin, end;
  };

  void sort_into_cells();
  void find_ranges(const IntVec<D>& cell);
  void count_pairs(std::size_t particle);
  void count_all();
  void count_all_avx2();
  Vec<D> position_of(std::size_t place) const {
    Vec<D> position;
    for (int axis = 0; axis < D; ++axis) position[axis] = coordinates_[axis][place];
    return position;
  }
  double edge(int bin) const;
  double expected_share(double low, double high) const;

  const Simulation<D>& simulation_;
  RadialDistributionSettings settings_;
  double range_;                                         // of distances
  IntVec<D> cells_;                                      // along each axis; x is fastest
  Vec<D> period_;                                        // infinite along axes with walls
  std::array<std::vector<std::vector<Range>>, D> near_;  // [cells] near cells, first and last
  std::vector<std::size_t> first_;                       // [cells + 1] first particle of each cell
  std::array<std::vector<double>, D> coordinates_;       // [N] in the order of the cells
  std::vector<Range> ranges_;                            // near the present cell
  std::vector<int> bins_;                                // of the pairs with one range
  double samples_ = 0.0;
  std::vector<std::uint64_t> counts_;  // [kBinShare bins + 1] pairs; the last beyond all
};

extern template class RadialDistribution<2>;
extern template class RadialDistribution<3>;

}  // namespace clatter
