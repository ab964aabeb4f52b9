#include "engine/observables/velocity_distribution.h"

#include <array>
#include <cmath>
#include <string>

#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums. The moments are relative to those of a Gaussian.
template <int D>
struct VelocitySums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kFourth = 1;   // of c^4 of the speed c in units of sqrt(2 T/m)
  static constexpr std::size_t kSixth = 2;    // of c^6
  static constexpr std::size_t kMoments = 3;  // second, third, fourth of each axis in turn
  static constexpr std::size_t kSpecies = kMoments + 3 * D;
  static constexpr std::size_t kOfSpecies = 3;  // count, second and fourth moment of the speed
  std::size_t speeds;                           // bins of |u|
  std::size_t tails;
  std::size_t bins;  // of each axis in turn, of all particles and of each species

  explicit VelocitySums(std::size_t species)
      : speeds(kSpecies + kOfSpecies * species),
        tails(speeds + LogBins::kCount),
        bins(tails + D * SignedLogBins::kCount) {}

  static constexpr std::size_t moments_of(std::size_t axis) { return kMoments + 3 * axis; }
  static constexpr std::size_t species_of(std::size_t species) {
    return kSpecies + kOfSpecies * species;
  }
  std::size_t tails_of(std::size_t axis) const { return tails + axis * SignedLogBins::kCount; }
};

// Factors that make the moments of Gaussian velocities those of a Gaussian, for any number of
// particles. The sample's own T and mean velocity are used, so the velocities are on a sphere in n
// dimensions (theory 11.5).
struct MomentFactors {
  double second, third, fourth, fourth_of_speed, sixth_of_speed;
};

template <int D>
MomentFactors moment_factors(double count) {
  const double n = D * (count - 1.0);
  const double own = count / (count - 1.0);  // n over the mean square of all particles
  const double fourth = own * own * (n + 2.0) / n;
  const double sixth = own * own * own * (n + 2.0) * (n + 4.0) / (n * n);
  return {own, own * std::sqrt(own), fourth, fourth * 4.0 / (D * (D + 2)),
          sixth * 8.0 / (D * (D + 2) * (D + 4))};
}

}  // namespace

template <int D>
VelocityDistribution<D>::VelocityDistribution(const Simulation<D>& simulation,
                                              const VelocityDistributionSettings& settings)
    : simulation_(simulation),
      range_(settings.range),
      bins_(static_cast<std::size_t>(settings.bins)),
      species_(simulation.model().species ? simulation.model().species->count() : 0) {
  if (settings.region.lower || settings.region.upper) {
    region_.emplace(simulation.model(), settings.region, 0.0, 1.0);
  }
}

template <int D>
std::size_t VelocityDistribution<D>::size() const {
  return VelocitySums<D>(species_).bins + (1 + species_) * D * bins_;
}

template <int D>
std::size_t VelocityDistribution<D>::mean_size() const {
  return VelocitySums<D>(species_).speeds;
}

template <int D>
void VelocityDistribution<D>::find_velocities() {
  velocities_.clear();
  masses_.clear();
  species_of_.clear();
  const bool mixed = simulation_.is_mixture();
  if (region_) {
    const State<D> state = simulation_.state();
    const Domain<D> domain = simulation_.domain();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      if (!region_->contains(state.positions[i])) continue;
      velocities_.push_back(domain.peculiar(state.positions[i], state.velocities[i]));
      if (mixed) note(state.grains[i]);
    }
    return;
  }
  const double now = simulation_.base_time();
  for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
    const Flight<D>& flight = simulation_.particles()[i].flight;
    velocities_.push_back(simulation_.peculiar_at(flight, now));
    if (mixed) note(simulation_.grain(i));
  }
}

template <int D>
void VelocityDistribution<D>::note(const Grain& grain) {
  masses_.push_back(grain.mass);
  species_of_.push_back(grain.species);
}

// Replaces velocities by peculiar ones, times the root of the mass. Returns the mass of all.
template <int D>
double VelocityDistribution<D>::centre() {
  Vec<D> mean = Vec<D>::Zero();
  if (masses_.empty()) {
    const auto count = static_cast<double>(velocities_.size());
    for (const Vec<D>& velocity : velocities_) mean += velocity;
    mean /= count;
    for (Vec<D>& velocity : velocities_) velocity -= mean;
    return count;
  }
  double mass = 0.0;
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    mass += masses_[i];
    mean += masses_[i] * velocities_[i];
  }
  mean /= mass;
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    velocities_[i] = std::sqrt(masses_[i]) * (velocities_[i] - mean);
  }
  return mass;
}

template <int D>
void VelocityDistribution<D>::sample() {
  using Sums = VelocitySums<D>;
  const Sums at(species_);
  find_velocities();
  const auto count = static_cast<double>(velocities_.size());
  const double mass = centre();
  double squares = 0.0;
  for (const Vec<D>& velocity : velocities_) squares += velocity.squaredNorm();
  // The mean velocity takes D degrees of freedom.
  const double thermal = std::sqrt(squares / (D * (count - 1.0)));
  if (!std::isnormal(thermal)) return;
  const MomentFactors factors = moment_factors<D>(count);
  const double per_bin = static_cast<double>(bins_) / (2.0 * range_);
  std::vector<double>& sums = sums_.values;
  Vec<D> second = Vec<D>::Zero(), third = Vec<D>::Zero(), fourth = Vec<D>::Zero();
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    // Heavy particles have a smaller mean square: 1 - m/M, of masses that are equal 1 - 1/N.
    const double weight =
        masses_.empty() ? 1.0 : (count - 1.0) / (count * (1.0 - masses_[i] / mass));
    const Vec<D> scaled = velocities_[i] / thermal;
    const double square = 0.5 * weight * scaled.squaredNorm();
    sums[Sums::kFourth] += factors.fourth_of_speed * square * square;
    sums[Sums::kSixth] += factors.sixth_of_speed * square * square * square;
    sums[at.speeds + LogBins::of(scaled.norm())] += 1.0;
    if (species_ > 0) {
      double* const own = &sums[Sums::species_of(species_of_[i])];
      own[0] += 1.0;
      own[1] += factors.second * 2.0 / D * square;
      own[2] += factors.fourth_of_speed * square * square;
    }
    const Vec<D> squared = weight * scaled.cwiseProduct(scaled);
    second += squared;
    third += std::sqrt(weight) * squared.cwiseProduct(scaled);
    fourth += squared.cwiseProduct(squared);
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double component = scaled[static_cast<int>(axis)];
      sums[at.tails_of(axis) + SignedLogBins::of(component)] += 1.0;
      const double bin = (component + range_) * per_bin;
      if (!(bin >= 0.0 && bin < static_cast<double>(bins_))) continue;
      const std::size_t place = at.bins + axis * bins_ + static_cast<std::size_t>(bin);
      sums[place] += 1.0;
      if (species_ > 0) sums[place + (1 + species_of_[i]) * D * bins_] += 1.0;
    }
  }
  for (std::size_t axis = 0; axis < D; ++axis) {
    double* const moments = &sums[Sums::moments_of(axis)];
    moments[0] += factors.second * second[static_cast<int>(axis)];
    moments[1] += factors.third * third[static_cast<int>(axis)];
    moments[2] += factors.fourth * fourth[static_cast<int>(axis)];
  }
  sums[Sums::kCount] += count;
}

// Numbers of the species that have particles.
template <int D>
std::vector<std::size_t> VelocityDistribution<D>::species_present() const {
  std::vector<std::size_t> counts(species_), present;
  if (species_ == 0) return present;
  for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
    ++counts[simulation_.grain(i).species];
  }
  for (std::size_t s = 0; s < species_; ++s) {
    if (counts[s] > 0) present.push_back(s);
  }
  return present;
}

// The densities of one species.
template <int D>
void VelocityDistribution<D>::add_species(ResultTable& table, std::size_t species,
                                          const ObservableParts& parts) const {
  const double width = 2.0 * range_ / static_cast<double>(bins_);
  const std::size_t first = VelocitySums<D>(species_).bins + (1 + species) * D * bins_;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const std::string name = axis_name(axis) + '_' + simulation_.model().species->name(species);
    TableColumn& column = table.columns.emplace_back(TableColumn{name, "1", {}});
    for (std::size_t bin = 0; bin < bins_; ++bin) {
      append(column, ratio_of(parts.coarse, first + axis * bins_ + bin,
                              VelocitySums<D>::species_of(species), width));
    }
  }
}

// a2 of a species: <c^4> over its Gaussian value for the species' own <c^2>, minus 1.
template <int D>
Estimate VelocityDistribution<D>::species_a2(std::size_t species,
                                             const ObservableParts& parts) const {
  const std::size_t count = VelocitySums<D>::species_of(species);
  double all = 0.0, second = 0.0, fourth = 0.0;
  for (const ObservableSums& part : parts.fine) {
    all += part.values[count];
    second += part.values[count + 1];
    fourth += part.values[count + 2];
  }
  second /= all;
  fourth /= all;
  // Linearised about the means: d(m4/m2^2) = dm4/m2^2 - 2 m4 dm2/m2^3.
  std::vector<double> numerator, denominator;
  for (const ObservableSums& part : parts.fine) {
    numerator.push_back(part.values[count + 2] / (second * second) -
                        2.0 * fourth * part.values[count + 1] / (second * second * second));
    denominator.push_back(part.values[count]);
  }
  Estimate a2 = ratio_of(numerator, denominator);
  a2.mean = fourth / (second * second) - 1.0;
  return a2;
}

template <int D>
ResultTable VelocityDistribution<D>::components(const ObservableParts& parts) const {
  ResultTable table{"velocity_distribution", {{"low", "1", {}}, {"high", "1", {}}}};
  for (std::size_t axis = 0; axis < D; ++axis) table.columns.push_back({axis_name(axis), "1", {}});
  const double width = 2.0 * range_ / static_cast<double>(bins_);
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    table.columns[0].values.push_back(-range_ + static_cast<double>(bin) * width);
    table.columns[1].values.push_back(-range_ + static_cast<double>(bin + 1) * width);
    for (std::size_t axis = 0; axis < D; ++axis) {
      append(table.columns[2 + axis],
             ratio_of(parts.coarse, VelocitySums<D>(species_).bins + axis * bins_ + bin,
                      VelocitySums<D>::kCount, width));
    }
  }
  for (const std::size_t s : species_present()) add_species(table, s, parts);
  return table;
}

template <int D>
ObservableResult VelocityDistribution<D>::result(const ObservableParts& parts) const {
  using Sums = VelocitySums<D>;
  const Sums at(species_);
  Estimate a2 = ratio_of(parts.fine, Sums::kFourth, Sums::kCount);
  a2.mean -= 1.0;
  // <c^6> = <c^6>_Gauss (1 + 3 a2 - a3)
  std::vector<double> numerator, denominator;
  for (const ObservableSums& part : parts.fine) {
    numerator.push_back(3.0 * part.values[Sums::kFourth] - part.values[Sums::kSixth]);
    denominator.push_back(part.values[Sums::kCount]);
  }
  Estimate a3 = ratio_of(numerator, denominator);
  a3.mean -= 2.0;
  ObservableResult result{{components(parts)},
                          {{"velocity_distribution.a2", a2}, {"velocity_distribution.a3", a3}}};
  std::vector<NamedBins> axes;
  constexpr std::array<const char*, 3> kMoments = {"second", "third", "fourth"};
  for (std::size_t axis = 0; axis < D; ++axis) {
    axes.push_back({axis_name(axis), at.tails_of(axis)});
    for (std::size_t moment = 0; moment < kMoments.size(); ++moment) {
      result.means.emplace_back(
          std::string("velocity_distribution.") + kMoments[moment] + "_moment_" + axis_name(axis),
          ratio_of(parts.fine, Sums::moments_of(axis) + moment, Sums::kCount));
    }
  }
  result.tables.push_back(
      signed_log_histogram("velocity_distribution.tails", "1", parts.coarse, axes, Sums::kCount));
  result.tables.push_back(
      log_histogram("velocity_distribution.speed", "1", parts.coarse, at.speeds, Sums::kCount));
  for (const std::size_t s : species_present()) {
    const std::string name = simulation_.model().species->name(s);
    result.means.emplace_back("velocity_distribution.temperature_ratio_" + name,
                              ratio_of(parts.fine, Sums::species_of(s) + 1, Sums::species_of(s)));
    result.means.emplace_back("velocity_distribution.a2_" + name, species_a2(s, parts));
  }
  return result;
}

template class VelocityDistribution<2>;
template class VelocityDistribution<3>;

}  // namespace clatter
