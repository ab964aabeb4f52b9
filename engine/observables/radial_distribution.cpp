#include "engine/observables/radial_distribution.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clatter {

// Sums: samples, g at contact times samples, pairs in each bin.
struct RadialSums {
  static constexpr std::size_t kSamples = 0;
  static constexpr std::size_t kContact = 1;
  static constexpr std::size_t kBins = 2;
};

std::vector<double> contact_weights(double bin_width, std::size_t all_bins) {
  constexpr double kReach = 0.2;  // diameters
  constexpr double kMinBins = 6.0;
  const double within = std::floor(kReach / bin_width);
  if (!(within >= kMinBins && within <= static_cast<double>(all_bins))) return {};
  const auto bins = static_cast<Eigen::Index>(within);
  Eigen::MatrixX3d powers(bins, 3);
  for (Eigen::Index k = 0; k < bins; ++k) {
    const double x = (static_cast<double>(k) + 0.5) * bin_width;
    powers.row(k) << 1.0, x, x * x;
  }
  const Eigen::Matrix3d normal = powers.transpose() * powers;
  const Eigen::VectorXd weights = powers * normal.ldlt().solve(Eigen::Vector3d::UnitX());
  return {weights.begin(), weights.end()};
}

template <int D>
RadialDistribution<D>::RadialDistribution(const Simulation<D>& simulation,
                                          const RadialDistributionSettings& settings)
    : simulation_(simulation),
      bins_(static_cast<std::size_t>(settings.bins)),
      range_(longest_distance(simulation.model(), settings.range)),
      width_((range_ - simulation.model().diameter) / settings.bins),
      cells_(simulation.model(), simulation.particles().size(), range_),
      contact_weights_(contact_weights(width_, bins_)),
      single_precision_((simulation.model().box.maxCoeff() + range_) *
                            std::numeric_limits<float>::epsilon() <
                        1e-3 * width_) {
  const auto count = static_cast<double>(simulation.particles().size());
  const double pairs = 0.5 * count * (count - 1.0);
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    expected_.push_back(pairs * expected_share(edge(bin), edge(bin + 1)));
  }
  if (pairs == 0.0) contact_weights_.clear();
}

template <int D>
std::size_t RadialDistribution<D>::size() const {
  return RadialSums::kBins + bins_;
}

template <int D>
std::size_t RadialDistribution<D>::mean_size() const {
  return RadialSums::kBins;
}

template <int D>
void RadialDistribution<D>::start() {
  samples_ = 0.0;
  counts_.assign(kBinShare * bins_ + 1, 0);
}

template <int D>
void RadialDistribution<D>::restore(ArchiveReader& io) {
  io(samples_, counts_);
  io.require(counts_.size() == kBinShare * bins_ + 1);
}

template <int D>
double RadialDistribution<D>::edge(std::size_t bin) const {
  return simulation_.model().diameter + width_ * static_cast<double>(bin);
}

// Bins of the distances of particles from `own`: [count] coordinates along each axis. Rounding may
// put a contact below the diameter.
template <typename Real, int D>
[[gnu::always_inline]] static inline void find_bins(const std::array<Real, D>& own,
                                                    const std::array<const Real*, D>& others,
                                                    Real diameter, Real per_distance, Real last,
                                                    std::size_t count, int* bins) {
  for (std::size_t k = 0; k < count; ++k) {
    Real square = 0;
    for (int axis = 0; axis < D; ++axis) {
      const Real apart = own[axis] - others[axis][k];
      square += apart * apart;
    }
    const Real bin = (std::sqrt(square) - diameter) * per_distance;
    bins[k] = static_cast<int>(std::min(last, std::max(Real{0}, bin)));
  }
}

// Runs are extended to whole vectors. The next run replaces the bins of the extension.
template <int D>
template <typename Real>
[[gnu::always_inline]] inline void RadialDistribution<D>::count_all(
    const Coordinates<Real>& coordinates) {
  constexpr std::size_t kLanes = 32 / sizeof(Real), kBatch = 512;
  static_assert(kLanes <= NearCells<D>::kPadding);
  const auto diameter = static_cast<Real>(simulation_.model().diameter);
  const auto per_distance = static_cast<Real>(1.0 / width_);
  const auto last = static_cast<Real>(kBinShare * bins_);
  std::size_t found = 0;
  const auto count_found = [&]() __attribute__((always_inline)) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < found; ++k) ++counts_[static_cast<std::size_t>(bins_of_pairs_[k])];
    found = 0;
  };
  cells_.each_run([&](std::size_t, const typename NearCells<D>::Run& run)
                      __attribute__((always_inline)) {
                        const std::size_t pairs = run.end - run.begin;
                        const std::size_t whole = (pairs + kLanes - 1) / kLanes * kLanes;
                        if (bins_of_pairs_.size() < found + whole)
                          bins_of_pairs_.resize(found + whole);
                        std::array<Real, D> own;
                        std::array<const Real*, D> others;
                        for (int axis = 0; axis < D; ++axis) {
                          own[axis] = static_cast<Real>(run.from[axis]);
                          others[axis] = &coordinates[axis][run.begin];
                        }
                        find_bins<Real, D>(own, others, diameter, per_distance, last, whole,
                                           bins_of_pairs_.data() + found);
                        found += pairs;
                        if (found >= kBatch) count_found();
                      });
  count_found();
}

#if defined(__x86_64__)
template <int D>
template <typename Real>
[[gnu::target("avx2")]] void RadialDistribution<D>::count_all_avx2(
    const Coordinates<Real>& coordinates) {
  count_all<Real>(coordinates);
}
#endif

// Wider vectors have equal results.
template <int D>
template <typename Real>
void RadialDistribution<D>::count(const Coordinates<Real>& coordinates) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return count_all_avx2<Real>(coordinates);
#endif
  count_all<Real>(coordinates);
}

template <int D>
void RadialDistribution<D>::sample() {
  cells_.sort(simulation_.positions(), simulation_.domain());
  samples_ += 1.0;
  if (!single_precision_) return count(cells_.coordinates());
  for (int axis = 0; axis < D; ++axis) {
    const std::vector<double>& exact = cells_.coordinates()[axis];
    rounded_[axis].resize(exact.size());
    std::transform(exact.begin(), exact.end(), rounded_[axis].begin(),
                   [](double coordinate) { return static_cast<float>(coordinate); });
  }
  count(rounded_);
}

template <int D>
ObservableSums RadialDistribution<D>::close_window() {
  ObservableSums window{{samples_, 0.0}};
  window.values.insert(window.values.end(), counts_.begin(),
                       counts_.begin() + static_cast<long>(bins_));
  for (std::size_t k = 0; k < contact_weights_.size(); ++k) {
    window.values[RadialSums::kContact] +=
        contact_weights_[k] * window.values[RadialSums::kBins + k] / expected_[k];
  }
  start();
  return window;
}

// Probability that two independent uniform particles are at a distance between `low` and `high`:
// the integral of the isotropised set covariance of the region (theory 11.7).
template <int D>
double RadialDistribution<D>::expected_share(double low, double high) const {
  constexpr double kPi = std::numbers::pi;
  const Model<D>& model = simulation_.model();
  // Elementary symmetric polynomials of the inverse lengths between walls.
  std::array<double, 4> symmetric = {1.0, 0.0, 0.0, 0.0};
  double volume = 1.0;
  for (int axis = 0; axis < D; ++axis) {
    const double room = room_of(model, axis);
    volume *= room;
    if (model.periodic(axis)) continue;
    for (int k = D; k > 0; --k) symmetric[k] += symmetric[k - 1] / room;
  }
  // Means of products of |components| of a unit vector.
  constexpr std::array<double, 4> kMeans =
      D == 2 ? std::array{1.0, 2.0 / kPi, 1.0 / kPi, 0.0}
             : std::array{1.0, 0.5, 2.0 / (3.0 * kPi), 1.0 / (4.0 * kPi)};
  constexpr double kSphere = D == 2 ? 2.0 * kPi : 4.0 * kPi;
  double integral = 0.0;
  for (int k = 0; k <= D; ++k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    integral +=
        sign * kMeans[k] * symmetric[k] * (std::pow(high, D + k) - std::pow(low, D + k)) / (D + k);
  }
  return kSphere * integral / volume;
}

template <int D>
ObservableResult RadialDistribution<D>::result(const ObservableParts& parts) const {
  ResultTable table{"radial_distribution", {{"r", "a", {}}, {"g", "1", {}}}};
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    table.columns[0].values.push_back(0.5 * (edge(bin) + edge(bin + 1)));
    append(table.columns[1],
           ratio_of(parts.coarse, RadialSums::kBins + bin, RadialSums::kSamples, expected_[bin]));
  }
  ObservableResult result{{std::move(table)}, {}};
  if (contact_weights_.empty()) return result;
  result.means.emplace_back("radial_distribution.contact",
                            ratio_of(parts.fine, RadialSums::kContact, RadialSums::kSamples));
  return result;
}

template class RadialDistribution<2>;
template class RadialDistribution<3>;

}  // namespace clatter
