#include "engine/observables/local_density.h"

#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums over cells and samples.
struct DensitySums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kNumber = 1;
  static constexpr std::size_t kSquare = 2;
  static constexpr std::size_t kBins = 3;
  static constexpr std::size_t kSize = kBins + CountBins::kCount;
};

}  // namespace

template <int D>
LocalDensity<D>::LocalDensity(const Simulation<D>& simulation, const CellSettings& settings)
    : simulation_(simulation), cells_(simulation.model().box, settings) {}

template <int D>
std::size_t LocalDensity<D>::size() const {
  return DensitySums::kSize;
}

template <int D>
std::size_t LocalDensity<D>::mean_size() const {
  return DensitySums::kBins;
}

template <int D>
void LocalDensity<D>::sample() {
  numbers_.assign(cells_.size(), 0);
  for (const Vec<D>& position : simulation_.positions()) {
    ++numbers_[cells_.of(position, simulation_.model().box)];
  }
  std::vector<double>& sums = sums_.values;
  sums[DensitySums::kCount] += static_cast<double>(numbers_.size());
  for (const std::uint32_t number : numbers_) {
    sums[DensitySums::kNumber] += number;
    sums[DensitySums::kSquare] += static_cast<double>(number) * number;
    sums[DensitySums::kBins + CountBins::of(number)] += 1.0;
  }
}

template <int D>
ObservableResult LocalDensity<D>::result(const ObservableParts& parts) const {
  return {{count_histogram("local_density.number", parts.coarse, DensitySums::kBins,
                           DensitySums::kCount)},
          {{"local_density.mean_number",
            ratio_of(parts.fine, DensitySums::kNumber, DensitySums::kCount)},
           {"local_density.number_variance", variance_of(parts.fine, DensitySums::kCount)}}};
}

template class LocalDensity<2>;
template class LocalDensity<3>;

}  // namespace clatter
