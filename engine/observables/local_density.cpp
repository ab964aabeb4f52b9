#include "engine/observables/local_density.h"

#include <algorithm>

#include "engine/observables/count_bins.h"
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

// The cells have at least the edge length of the settings.
template <int D>
LocalDensity<D>::LocalDensity(const Simulation<D>& simulation, const LocalDensitySettings& settings)
    : simulation_(simulation) {
  for (int axis = 0; axis < D; ++axis) {
    cells_[axis] = static_cast<int>(settings.cells_along(simulation.model().box[axis]));
  }
}

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
  const Vec<D>& box = simulation_.model().box;
  std::size_t cells = 1;
  for (const int count : cells_) cells *= static_cast<std::size_t>(count);
  numbers_.assign(cells, 0);
  for (const Vec<D>& position : simulation_.positions()) {
    std::size_t cell = 0;
    for (int axis = 0; axis < D; ++axis) {
      // Rounding may put a position at the upper edge of the box, or a centre beyond a moving wall.
      const double place = position[axis] / box[axis] * cells_[axis];
      const auto index = static_cast<std::size_t>(std::clamp(place, 0.0, cells_[axis] - 1.0));
      cell = cell * static_cast<std::size_t>(cells_[axis]) + index;
    }
    ++numbers_[cell];
  }
  std::vector<double>& sums = sums_.values;
  sums[DensitySums::kCount] += static_cast<double>(cells);
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
