#include "engine/observables/plane_current.h"

#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums over samples.
struct CurrentSums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kNumber = 1;
  static constexpr std::size_t kSquare = 2;
  static constexpr std::size_t kBins = 3;
  static constexpr std::size_t kSize = kBins + SignedCountBins::kCount;
};

}  // namespace

template <int D>
std::size_t PlaneCurrent<D>::size() const {
  return CurrentSums::kSize;
}

template <int D>
std::size_t PlaneCurrent<D>::mean_size() const {
  return CurrentSums::kBins;
}

template <int D>
void PlaneCurrent<D>::start() {
  Observable::start();
  images_.emplace(simulation_);
  beyond_ = beyond();
}

template <int D>
void PlaneCurrent<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  io(*images_, beyond_);
}

template <int D>
void PlaneCurrent<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  images_.emplace(simulation_);
  io(*images_, beyond_);
}

// The sum (theory 11.14), up to a constant: each crossing in the direction of the normal adds 1.
template <int D>
std::int64_t PlaneCurrent<D>::beyond() const {
  const auto axis = static_cast<int>(settings_.axis);
  const std::vector<Vec<D>> positions = simulation_.positions();
  const std::vector<IntVec<D>> images = images_->images();
  const double plane = settings_.position * simulation_.model().box[axis];
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    sum += images[i][axis] + (positions[i][axis] >= plane ? 1 : 0);
  }
  return sum;
}

template <int D>
void PlaneCurrent<D>::sample() {
  const std::int64_t now = beyond();
  const std::int64_t net = now - beyond_;
  beyond_ = now;
  const auto number = static_cast<double>(net);
  std::vector<double>& sums = sums_.values;
  sums[CurrentSums::kCount] += 1.0;
  sums[CurrentSums::kNumber] += number;
  sums[CurrentSums::kSquare] += number * number;
  sums[CurrentSums::kBins + SignedCountBins::of(net)] += 1.0;
}

template <int D>
ObservableResult PlaneCurrent<D>::result(const ObservableParts& parts) const {
  return {{signed_count_histogram("plane_current.number", parts.coarse, CurrentSums::kBins,
                                  CurrentSums::kCount)},
          {{"plane_current.mean_number",
            ratio_of(parts.fine, CurrentSums::kNumber, CurrentSums::kCount)},
           {"plane_current.number_variance", variance_of(parts.fine, CurrentSums::kCount)}}};
}

template class PlaneCurrent<2>;
template class PlaneCurrent<3>;

}  // namespace clatter
