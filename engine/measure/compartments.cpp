#include "engine/measure/compartments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clatter {

template <int D>
std::optional<AxisPlane> compartment_plane(const Simulation<D>& simulation) {
  const Model<D>& model = simulation.model();
  if (const PistonFlight* piston = simulation.free_piston()) {
    return AxisPlane{model.free_piston->axis, piston->at(simulation.base_time())};
  }
  for (const Fixture<D>& fixture : model.fixtures) {
    if (fixture.plane && !model.periodic(fixture.plane->axis)) return fixture.plane;
  }
  return std::nullopt;
}

template <int D>
void CompartmentSeries::sample(const Simulation<D>& simulation, const AxisPlane& plane,
                               std::size_t number) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (auto* series : {&position, &share_left, &temperature_left, &temperature_right}) {
    series->resize(number, kNone);
  }
  position.push_back(plane.position);
  const double now = simulation.base_time();
  const Vec<D>& gravity = simulation.model().gravity;
  const Domain<D> domain = simulation.domain();
  std::array<double, 2> counts{}, squares{};  // left, right
  simulation.for_masses([&](const Flight<D>& flight, double mass) {
    const std::size_t side =
        domain.wrapped(flight.at(now, gravity))[plane.axis] < plane.position ? 0 : 1;
    counts[side] += 1.0;
    squares[side] += mass * flight.velocity_at(now, gravity).squaredNorm();
  });
  const double all = counts[0] + counts[1];
  share_left.push_back(all > 0.0 ? counts[0] / all : 0.0);
  temperature_left.push_back(counts[0] > 0.0 ? squares[0] / (D * counts[0]) : kNone);
  temperature_right.push_back(counts[1] > 0.0 ? squares[1] / (D * counts[1]) : kNone);
}

// The density of shares in bins. The number of bins is odd, so that equal shares are in the middle
// of one.
static std::vector<Estimate> share_distribution(const std::vector<double>& shares) {
  constexpr int kBins = 21;
  std::vector<Estimate> density;
  for (int bin = 0; bin < kBins; ++bin) {
    std::vector<double> inside;
    for (const double share : shares) {
      inside.push_back(std::min(static_cast<int>(share * kBins), kBins - 1) == bin ? kBins : 0.0);
    }
    density.push_back(mean_estimate(inside));
  }
  return density;
}

CompartmentMeans compartment_means(const CompartmentSeries& series, std::size_t first,
                                   double count) {
  std::vector<double> shares, imbalances;
  const auto temperature = [&](const std::vector<double>& all) -> std::optional<Estimate> {
    std::vector<double> known;
    for (std::size_t k = first; k < all.size(); ++k) {
      if (!std::isnan(all[k])) known.push_back(all[k]);
    }
    if (known.empty()) return std::nullopt;
    return mean_estimate(known);
  };
  for (std::size_t k = first; k < series.share_left.size(); ++k) {
    if (std::isnan(series.share_left[k])) continue;
    shares.push_back(series.share_left[k]);
    imbalances.push_back(std::fabs(2.0 * series.share_left[k] - 1.0));
  }
  const Estimate share = mean_estimate(shares);
  Estimate number = share;
  number.mean *= count;
  number.standard_error *= count;
  return {number,
          share,
          mean_estimate(imbalances),
          share_distribution(shares),
          temperature(series.temperature_left),
          temperature(series.temperature_right),
          series.share_left,
          series.position};
}

template std::optional<AxisPlane> compartment_plane(const Simulation<2>&);
template std::optional<AxisPlane> compartment_plane(const Simulation<3>&);
template void CompartmentSeries::sample(const Simulation<2>&, const AxisPlane&, std::size_t);
template void CompartmentSeries::sample(const Simulation<3>&, const AxisPlane&, std::size_t);

}  // namespace clatter
