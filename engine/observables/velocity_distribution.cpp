#include "engine/observables/velocity_distribution.h"

#include <cmath>
#include <string>

#include "engine/observables/histogram.h"
#include "engine/observables/log_bins.h"
#include "engine/scene/scene_keys.h"

namespace clatter {

namespace {

// Layout of the sums. The speed c is in units of sqrt(2 T/m).
struct VelocitySums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kFourth = 1;                        // of c^4
  static constexpr std::size_t kSixth = 2;                         // of c^6
  static constexpr std::size_t kSpeeds = 3;                        // bins of |u|
  static constexpr std::size_t kBins = kSpeeds + LogBins::kCount;  // of each axis in turn
};

}  // namespace

template <int D>
std::size_t VelocityDistribution<D>::size() const {
  return VelocitySums::kBins + static_cast<std::size_t>(D * settings_.bins);
}

template <int D>
std::size_t VelocityDistribution<D>::mean_size() const {
  return VelocitySums::kSpeeds;
}

template <int D>
void VelocityDistribution<D>::sample() {
  const auto& particles = simulation_.particles();
  const auto count = static_cast<double>(particles.size());
  const double now = simulation_.base_time();
  const Vec<D>& gravity = simulation_.model().gravity;
  Vec<D> mean = Vec<D>::Zero();
  for (const Particle<D>& particle : particles) mean += particle.flight.velocity_at(now, gravity);
  mean /= count;
  double squares = 0.0;
  for (const Particle<D>& particle : particles) {
    squares += (particle.flight.velocity_at(now, gravity) - mean).squaredNorm();
  }
  // The mean velocity takes D degrees of freedom.
  const double thermal = std::sqrt(squares / (D * (count - 1.0)));
  if (!std::isnormal(thermal)) return;
  const double per_bin = settings_.bins / (2.0 * settings_.range);
  std::vector<double>& sums = sums_.values;
  for (const Particle<D>& particle : particles) {
    const Vec<D> scaled = (particle.flight.velocity_at(now, gravity) - mean) / thermal;
    const double square = 0.5 * scaled.squaredNorm();
    sums[VelocitySums::kFourth] += square * square;
    sums[VelocitySums::kSixth] += square * square * square;
    sums[VelocitySums::kSpeeds + LogBins::of(scaled.norm())] += 1.0;
    for (int axis = 0; axis < D; ++axis) {
      const double bin = (scaled[axis] + settings_.range) * per_bin;
      if (!(bin >= 0.0 && bin < settings_.bins)) continue;
      sums[VelocitySums::kBins + static_cast<std::size_t>(axis * settings_.bins) +
           static_cast<std::size_t>(bin)] += 1.0;
    }
  }
  sums[VelocitySums::kCount] += count;
}

// (theory 11.5). The sample's own T and mean velocity are used, so the velocities are on a sphere
// in n dimensions. The factors make a2 and a3 of a uniform distribution on it 0.
template <int D>
ObservableResult VelocityDistribution<D>::result(const ObservableParts& parts) const {
  const double count = static_cast<double>(simulation_.particles().size());
  const double n = D * (count - 1.0);
  const double own = count / (count - 1.0);  // n over the mean square of all particles
  const double fourth_gauss = D * (D + 2) / 4.0 * n / (n + 2.0) / (own * own);
  const double sixth_gauss =
      D * (D + 2) * (D + 4) / 8.0 * n * n / ((n + 2.0) * (n + 4.0)) / (own * own * own);
  Estimate a2 = ratio_of(parts.fine, VelocitySums::kFourth, VelocitySums::kCount, fourth_gauss);
  a2.mean -= 1.0;
  // <c^6> = <c^6>_Gauss (1 + 3 a2 - a3)
  std::vector<double> numerator, denominator;
  for (const ObservableSums& part : parts.fine) {
    const std::vector<double>& sums = part.values;
    numerator.push_back(3.0 * sums[VelocitySums::kFourth] / fourth_gauss -
                        sums[VelocitySums::kSixth] / sixth_gauss);
    denominator.push_back(sums[VelocitySums::kCount]);
  }
  Estimate a3 = ratio_of(numerator, denominator);
  a3.mean -= 2.0;

  ResultTable table{"velocity_distribution", {{"low", "1", {}}, {"high", "1", {}}}};
  for (int axis = 0; axis < D; ++axis) {
    table.columns.push_back({std::string(kAxes[static_cast<std::size_t>(axis)].name), "1", {}});
  }
  const double width = 2.0 * settings_.range / settings_.bins;
  for (int bin = 0; bin < settings_.bins; ++bin) {
    table.columns[0].values.push_back(-settings_.range + bin * width);
    table.columns[1].values.push_back(-settings_.range + (bin + 1) * width);
    for (int axis = 0; axis < D; ++axis) {
      const auto index =
          VelocitySums::kBins + static_cast<std::size_t>(axis * settings_.bins + bin);
      append(table.columns[static_cast<std::size_t>(2 + axis)],
             ratio_of(parts.coarse, index, VelocitySums::kCount, width));
    }
  }
  ResultTable speeds = log_histogram("velocity_distribution.speed", "1", parts.coarse,
                                     VelocitySums::kSpeeds, VelocitySums::kCount);
  return {{std::move(table), std::move(speeds)},
          {{"velocity_distribution.a2", a2}, {"velocity_distribution.a3", a3}}};
}

template class VelocityDistribution<2>;
template class VelocityDistribution<3>;

}  // namespace clatter
