#include "engine/observables/radial_distribution_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/observables/radial_distribution.h"
#include "engine/scene/enum_names.h"

namespace clatter {

namespace {

// Layout of the sums: samples, the number of particles in each slab, and for each slab the pairs of
// its particles in each bin.
struct ProfileSums {
  static constexpr std::size_t kSamples = 0;
  static constexpr std::size_t kNumbers = 1;
};

// Simpson's rule.
template <class Function>
double integral(const Function& function, double low, double high) {
  constexpr int kPanels = 16;
  const double step = (high - low) / kPanels;
  double sum = 0.0;
  for (int k = 0; k < kPanels; ++k) {
    const double from = low + k * step;
    sum += function(from) + 4.0 * function(from + 0.5 * step) + function(from + step);
  }
  return sum * step / 6.0;
}

}  // namespace

template <int D>
RadialDistributionProfile<D>::RadialDistributionProfile(const Simulation<D>& simulation,
                                                        const RadialProfileSettings& settings)
    : simulation_(simulation),
      axis_(static_cast<int>(settings.axis)),
      slabs_(static_cast<std::size_t>(settings.slabs)),
      bins_(static_cast<std::size_t>(settings.bins)),
      periodic_(simulation.model().periodic(axis_)),
      begin_(periodic_ ? 0.0 : simulation.model().wall_plane(axis_, 0)),
      thickness_(room_of(simulation.model(), axis_) / settings.slabs),
      width_((longest_distance(simulation.model(), settings.range) - simulation.model().diameter) /
             settings.bins),
      cells_(simulation.model(), simulation.particles().size(), edge(bins_)) {
  for (std::size_t apart = 0; apart < slabs_; ++apart) {
    for (std::size_t bin = 0; bin < bins_; ++bin) {
      shares_.push_back(expected_share(apart, edge(bin), edge(bin + 1)));
    }
  }
}

template <int D>
std::size_t RadialDistributionProfile<D>::size() const {
  return ProfileSums::kNumbers + slabs_ + slabs_ * bins_;
}

template <int D>
double RadialDistributionProfile<D>::edge(std::size_t bin) const {
  return simulation_.model().diameter + width_ * static_cast<double>(bin);
}

// Moving walls let centres leave the region.
template <int D>
std::size_t RadialDistributionProfile<D>::slab_of(double coordinate) const {
  const double slab = (coordinate - begin_) / thickness_;
  return static_cast<std::size_t>(std::clamp(slab, 0.0, static_cast<double>(slabs_) - 1.0));
}

// Number of slabs from one to another: along a periodic axis in its direction.
template <int D>
std::size_t RadialDistributionProfile<D>::apart(std::size_t slab, std::size_t other) const {
  if (periodic_) return (other + slabs_ - slab) % slabs_;
  return slab < other ? other - slab : slab - other;
}

// Per unit of distance: the integral over the directions (theory 11.22). Its integrand has kinks
// where the edges of the slabs meet.
template <int D>
double RadialDistributionProfile<D>::share_at(std::size_t apart, double distance) const {
  constexpr double kPi = std::numbers::pi;
  const Model<D>& model = simulation_.model();
  double inverse_sum = 0.0, inverse_product = 1.0, rooms = 1.0;  // of the other axes
  for (int axis = 0; axis < D; ++axis) {
    if (axis == axis_) continue;
    const double room = room_of(model, axis);
    rooms *= room;
    const double inverse = model.periodic(axis) ? 0.0 : 1.0 / room;
    inverse_sum += inverse;
    inverse_product *= inverse;
  }
  const double period = thickness_ * static_cast<double>(slabs_);
  std::vector<double> centres = {thickness_ * static_cast<double>(apart)};
  if (periodic_) centres.insert(centres.end(), {centres[0] - period, centres[0] + period});
  std::vector<double> kinks = {0.0, kPi};
  for (const double centre : centres) {
    for (const double place : {centre - thickness_, centre, centre + thickness_}) {
      if (std::fabs(place) < distance) kinks.push_back(std::acos(place / distance));
    }
  }
  std::ranges::sort(kinks);
  const auto integrand = [&](double angle) {
    const double along = distance * std::cos(angle), across = distance * std::sin(angle);
    double overlap = 0.0;
    for (const double centre : centres) {
      overlap += std::max(0.0, thickness_ - std::fabs(along - centre));
    }
    overlap /= thickness_ * thickness_;
    if constexpr (D == 2) {
      return 2.0 * distance * overlap * (1.0 - inverse_sum * across);
    } else {
      return 2.0 * kPi * distance * across * overlap *
             (1.0 - 2.0 / kPi * inverse_sum * across + inverse_product / kPi * across * across);
    }
  };
  double share = 0.0;
  for (std::size_t k = 1; k < kinks.size(); ++k) {
    share += integral(integrand, kinks[k - 1], kinks[k]);
  }
  return share / rooms;
}

// Probability that two particles, each uniform in its slab, are at a distance between `low` and
// `high`.
template <int D>
double RadialDistributionProfile<D>::expected_share(std::size_t apart, double low,
                                                    double high) const {
  if (!periodic_ && (static_cast<double>(apart) - 1.0) * thickness_ >= high) return 0.0;
  return integral([&](double distance) { return share_at(apart, distance); }, low, high);
}

template <int D>
void RadialDistributionProfile<D>::sample() {
  const std::vector<Vec<D>> positions = simulation_.positions();
  std::vector<double>& sums = sums_.values;
  sums[ProfileSums::kSamples] += 1.0;
  slab_of_.clear();
  for (const Vec<D>& position : positions) {
    const std::size_t slab = slab_of(position[axis_]);
    sums[ProfileSums::kNumbers + slab] += 1.0;
    slab_of_.push_back(static_cast<std::uint32_t>(slab));
  }
  cells_.sort(positions, simulation_.domain());
  double* const pairs = &sums[ProfileSums::kNumbers + slabs_];
  const double per_distance = 1.0 / width_;
  const double diameter = simulation_.model().diameter;
  cells_.each_pair([&](std::uint32_t first, std::uint32_t second, const Vec<D>& separation) {
    // Rounding may put a contact below the diameter, and the largest distance above the last bin.
    const double place = std::max(0.0, (separation.norm() - diameter) * per_distance);
    const auto bin = std::min(static_cast<std::size_t>(place), bins_ - 1);
    pairs[slab_of_[first] * bins_ + bin] += 1.0;
    pairs[slab_of_[second] * bins_ + bin] += 1.0;
  });
}

// [parts][bins] pairs of the particles of a slab, if they were independent. To first order in the
// fluctuations of the numbers, so that the ratio of both has their standard error.
template <int D>
std::vector<double> RadialDistributionProfile<D>::expected_pairs(
    std::size_t slab, const ObservableParts& parts) const {
  const double count = static_cast<double>(simulation_.particles().size());
  const auto number_in = [](const ObservableSums& part, std::size_t of) {
    return part.values[ProfileSums::kNumbers + of];
  };
  ObservableSums all{std::vector<double>(size(), 0.0)};
  for (const ObservableSums& part : parts.coarse) all += part;
  const double samples = all.values[ProfileSums::kSamples];
  const double own = number_in(all, slab) / samples;
  std::vector<double> expected(parts.coarse.size() * bins_, 0.0);
  for (std::size_t other = 0; other < slabs_; ++other) {
    const double* const shares = &shares_[apart(slab, other) * bins_];
    // The last bin has the longest reach.
    if (shares[bins_ - 1] == 0.0) continue;
    const double others = number_in(all, other) / samples;
    for (std::size_t k = 0; k < parts.coarse.size(); ++k) {
      const ObservableSums& part = parts.coarse[k];
      const double pairs = number_in(part, slab) * others + own * number_in(part, other) -
                           own * others * part.values[ProfileSums::kSamples];
      for (std::size_t bin = 0; bin < bins_; ++bin) {
        expected[k * bins_ + bin] += (1.0 - 1.0 / count) * pairs * shares[bin];
      }
    }
  }
  return expected;
}

template <int D>
ObservableResult RadialDistributionProfile<D>::result(const ObservableParts& parts) const {
  const std::string axis(kAxes[static_cast<std::size_t>(axis_)].name);
  ResultTable table{
      "radial_distribution_profile",
      {{axis + "_low", "a", {}}, {axis + "_high", "a", {}}, {"r", "a", {}}, {"g", "1", {}}}};
  for (std::size_t slab = 0; slab < slabs_; ++slab) {
    const std::vector<double> expected = expected_pairs(slab, parts);
    for (std::size_t bin = 0; bin < bins_; ++bin) {
      std::vector<double> found, independent;
      for (std::size_t k = 0; k < parts.coarse.size(); ++k) {
        found.push_back(
            parts.coarse[k].values[ProfileSums::kNumbers + slabs_ + slab * bins_ + bin]);
        independent.push_back(expected[k * bins_ + bin]);
      }
      table.columns[0].values.push_back(begin_ + thickness_ * static_cast<double>(slab));
      table.columns[1].values.push_back(begin_ + thickness_ * static_cast<double>(slab + 1));
      table.columns[2].values.push_back(0.5 * (edge(bin) + edge(bin + 1)));
      append(table.columns[3], ratio_of(found, independent));
    }
  }
  return {{std::move(table)}, {}};
}

template class RadialDistributionProfile<2>;
template class RadialDistributionProfile<3>;

}  // namespace clatter
