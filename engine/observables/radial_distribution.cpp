#include "engine/observables/radial_distribution.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clatter {

// The region of centres along an axis: the period, or the distance between wall planes.
template <int D>
static double room_of(const Model<D>& model, int axis) {
  return model.periodic(axis) ? model.box[axis]
                              : model.wall_plane(axis, 1) - model.wall_plane(axis, 0);
}

template <int D>
RadialDistribution<D>::RadialDistribution(const Simulation<D>& simulation,
                                          const RadialDistributionSettings& settings)
    : simulation_(simulation), settings_(settings), range_(settings.range) {
  // A dilute gas has about one particle per cell.
  const double most_cells =
      1.0 + 2.0 * std::pow(static_cast<double>(simulation.particles().size()), 1.0 / D);
  const Model<D>& model = simulation.model();
  // Beyond these distances expected_share() would need other terms.
  for (int axis = 0; axis < D; ++axis) {
    range_ = std::min(range_, (model.periodic(axis) ? 0.5 : 1.0) * room_of(model, axis));
    period_[axis] =
        model.periodic(axis) ? model.box[axis] : std::numeric_limits<double>::infinity();
  }
  // A pair within the range is in cells whose numbers differ by at most 2.
  for (int axis = 0; axis < D; ++axis) {
    const double finest = std::floor(2.0 * model.box[axis] / range_);
    const int cells = static_cast<int>(std::clamp(finest, 1.0, std::floor(most_cells)));
    cells_[axis] = cells;
    for (int cell = 0; cell < cells; ++cell) {
      std::vector<int> near;
      for (int other = cell - 2; other <= cell + 2; ++other) {
        if (!model.periodic(axis) && (other < 0 || other >= cells)) continue;
        const int wrapped = (other % cells + cells) % cells;
        if (std::ranges::find(near, wrapped) == near.end()) near.push_back(wrapped);
      }
      std::ranges::sort(near);
      std::vector<Range>& spans = near_[axis].emplace_back();
      for (const int number : near) {
        const auto next = static_cast<std::size_t>(number);
        if (!spans.empty() && spans.back().end + 1 == next) {
          spans.back().end = next;
        } else {
          spans.push_back({next, next});
        }
      }
    }
  }
}

template <int D>
void RadialDistribution<D>::start() {
  samples_ = 0.0;
  counts_.assign(static_cast<std::size_t>(kBinShare * settings_.bins) + 1, 0);
}

template <int D>
void RadialDistribution<D>::restore(ArchiveReader& io) {
  io(samples_, counts_);
  io.require(counts_.size() == static_cast<std::size_t>(kBinShare * settings_.bins) + 1);
}

template <int D>
double RadialDistribution<D>::edge(int bin) const {
  const double diameter = simulation_.model().diameter;
  return diameter + (range_ - diameter) * bin / settings_.bins;
}

template <int D>
void RadialDistribution<D>::sort_into_cells() {
  const State<D> state = simulation_.state();
  const std::size_t count = state.positions.size();
  const Vec<D> per_length = cells_.template cast<double>().cwiseQuotient(simulation_.model().box);
  std::vector<std::size_t> cell_of(count);
  first_.assign(static_cast<std::size_t>(cells_.prod()) + 1, 0);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t cell = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      const int along = static_cast<int>(state.positions[i][axis] * per_length[axis]);
      cell = cell * static_cast<std::size_t>(cells_[axis]) +
             static_cast<std::size_t>(std::clamp(along, 0, cells_[axis] - 1));
    }
    cell_of[i] = cell;
    ++first_[cell + 1];
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::vector<double>& along : coordinates_) along.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = next[cell_of[i]]++;
    for (int axis = 0; axis < D; ++axis) coordinates_[axis][place] = state.positions[i][axis];
  }
}

// The particles near a cell: in each near row, the cells that are consecutive along x.
template <int D>
void RadialDistribution<D>::find_ranges(const IntVec<D>& cell) {
  ranges_.clear();
  const auto add_row = [&](std::size_t row) {
    const std::size_t start = row * static_cast<std::size_t>(cells_[0]);
    for (const auto& [first, last] : near_[0][static_cast<std::size_t>(cell[0])]) {
      ranges_.push_back({first_[start + first], first_[start + last + 1]});
    }
  };
  const auto each_near = [&](int axis, const auto& visit) {
    for (const auto& [first, last] : near_[axis][static_cast<std::size_t>(cell[axis])]) {
      for (std::size_t near = first; near <= last; ++near) visit(near);
    }
  };
  if constexpr (D == 2) {
    each_near(1, add_row);
  } else {
    each_near(2, [&](std::size_t z) {
      each_near(1, [&](std::size_t y) { add_row(z * static_cast<std::size_t>(cells_[1]) + y); });
    });
  }
}

// Bins of the distances of particles from `own`: [count] coordinates along each axis. Rounding may
// put a contact below the diameter.
template <int D>
[[gnu::always_inline]] static inline void find_bins(const Vec<D>& own, const Vec<D>& period,
                                                    const std::array<const double*, D>& others,
                                                    double diameter, double per_distance,
                                                    double last, std::size_t count, int* bins) {
  for (std::size_t k = 0; k < count; ++k) {
    double square = 0.0;
    for (int axis = 0; axis < D; ++axis) {
      const double apart = std::fabs(own[axis] - others[axis][k]);
      const double nearest = std::min(apart, std::fabs(period[axis] - apart));
      square += nearest * nearest;
    }
    const double bin = (std::sqrt(square) - diameter) * per_distance;
    bins[k] = static_cast<int>(std::min(last, std::max(0.0, bin)));
  }
}

// Pairs of a particle and a later one in the ranges.
template <int D>
[[gnu::always_inline]] inline void RadialDistribution<D>::count_pairs(std::size_t particle) {
  const double diameter = simulation_.model().diameter;
  const double per_distance = settings_.bins / (range_ - diameter);
  const double last = kBinShare * settings_.bins;
  const Vec<D> own = position_of(particle);
  for (const Range& range : ranges_) {
    const std::size_t begin = std::max(range.begin, particle + 1);
    if (begin >= range.end) continue;
    const std::size_t count = range.end - begin;
    if (bins_.size() < count) bins_.resize(count);
    std::array<const double*, D> others;
    for (int axis = 0; axis < D; ++axis) others[axis] = &coordinates_[axis][begin];
    find_bins<D>(own, period_, others, diameter, per_distance, last, count, bins_.data());
    for (std::size_t k = 0; k < count; ++k) ++counts_[static_cast<std::size_t>(bins_[k])];
  }
}

template <int D>
[[gnu::always_inline]] inline void RadialDistribution<D>::count_all() {
  IntVec<D> at = IntVec<D>::Zero();
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    if (first_[cell] < first_[cell + 1]) find_ranges(at);
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) count_pairs(i);
    for (int axis = 0; axis < D && ++at[axis] == cells_[axis]; ++axis) at[axis] = 0;
  }
}

// The same with wider vectors, with equal results.
template <int D>
[[gnu::target("avx2")]] void RadialDistribution<D>::count_all_avx2() {
  count_all();
}

template <int D>
void RadialDistribution<D>::sample() {
  sort_into_cells();
  samples_ += 1.0;
  if (__builtin_cpu_supports("avx2")) {
    count_all_avx2();
  } else {
    count_all();
  }
}

template <int D>
ObservableSums RadialDistribution<D>::close_window() {
  ObservableSums window{{samples_}};
  window.values.insert(window.values.end(), counts_.begin(), counts_.begin() + settings_.bins);
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

// Weights of the bins' values that give the value at contact of the parabola fitted to the bins
// within kReach. Empty if these are too few.
static std::vector<double> contact_weights(double bin_width) {
  constexpr double kReach = 0.2;  // diameters
  constexpr Eigen::Index kMinBins = 6;
  const auto bins = static_cast<Eigen::Index>(kReach / bin_width);
  if (bins < kMinBins) return {};
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
ObservableResult RadialDistribution<D>::result(std::span<const ObservableSums> parts) const {
  const auto count = static_cast<double>(simulation_.particles().size());
  const double pairs = 0.5 * count * (count - 1.0);
  ResultTable table{"radial_distribution", {{"r", "a", {}}, {"g", "1", {}}}};
  std::vector<double> expected;
  for (int bin = 0; bin < settings_.bins; ++bin) {
    expected.push_back(pairs * expected_share(edge(bin), edge(bin + 1)));
    table.columns[0].values.push_back(0.5 * (edge(bin) + edge(bin + 1)));
    append(table.columns[1],
           ratio_of(parts, static_cast<std::size_t>(bin) + 1, 0, expected.back()));
  }
  ObservableResult result{{std::move(table)}, {}};
  const std::vector<double> weights = contact_weights(edge(1) - edge(0));
  if (weights.empty() || weights.size() > expected.size()) return result;
  std::vector<double> extrapolated, samples;
  for (const ObservableSums& part : parts) {
    double sum = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      sum += weights[k] * part.values[k + 1] / expected[k];
    }
    extrapolated.push_back(sum);
    samples.push_back(part.values[0]);
  }
  result.means.emplace_back("radial_distribution.contact", ratio_of(extrapolated, samples));
  return result;
}

template class RadialDistribution<2>;
template class RadialDistribution<3>;

}  // namespace clatter
