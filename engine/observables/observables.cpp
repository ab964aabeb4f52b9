#include "engine/observables/observables.h"

#include "engine/observables/bins.h"
#include "engine/observables/bond_order.h"
#include "engine/observables/clusters.h"
#include "engine/observables/collision_counts.h"
#include "engine/observables/collision_statistics.h"
#include "engine/observables/free_flights.h"
#include "engine/observables/local_density.h"
#include "engine/observables/plane_current.h"
#include "engine/observables/probe.h"
#include "engine/observables/radial_distribution.h"
#include "engine/observables/radial_distribution_profile.h"
#include "engine/observables/species_mixing.h"
#include "engine/observables/species_radial_distribution.h"
#include "engine/observables/spin_distribution.h"
#include "engine/observables/structure_factor.h"
#include "engine/observables/time_correlation.h"
#include "engine/observables/velocity_distribution.h"
#include "engine/observables/wall_hits.h"
#include "engine/observables/wall_power.h"
#include "engine/scene/act_checks.h"

namespace clatter {

template <int D>
static std::unique_ptr<Observable> make_bond_order(Simulation<D>& simulation,
                                                   const BondOrderSettings& settings) {
  if constexpr (D == 2) {
    return std::make_unique<BondOrder>(simulation, settings);
  } else {
    throw std::logic_error("bond order of spheres");
  }
}

// Between walls each species has its own region of centres, unless their diameters are equal.
template <int D>
static std::unique_ptr<Observable> make_radial_distribution(
    Simulation<D>& simulation, const RadialDistributionSettings& settings) {
  const Model<D>& model = simulation.model();
  if (model.species && model.is_periodic()) {
    return std::make_unique<SpeciesRadialDistribution<D>>(simulation, settings);
  }
  return std::make_unique<RadialDistribution<D>>(simulation, settings);
}

template <int D>
static std::unique_ptr<Observable> make_observable(ObservableKind kind, Simulation<D>& simulation,
                                                   const Measure& measure) {
  switch (kind) {
    case ObservableKind::RadialDistribution:
      return make_radial_distribution(simulation, measure.radial_distribution);
    case ObservableKind::VelocityDistribution:
      return std::make_unique<VelocityDistribution<D>>(simulation, measure.velocity_distribution);
    case ObservableKind::FreeFlights:
      return std::make_unique<FreeFlights<D>>(simulation);
    case ObservableKind::Collisions:
      return std::make_unique<CollisionStatistics<D>>(simulation);
    case ObservableKind::WallHits:
      return std::make_unique<WallHits<D>>(simulation);
    case ObservableKind::MeanSquaredDisplacement:
      return std::make_unique<MeanSquaredDisplacement<D>>(simulation,
                                                          measure.mean_squared_displacement);
    case ObservableKind::VelocityAutocorrelation:
      return std::make_unique<VelocityAutocorrelation<D>>(simulation,
                                                          measure.velocity_autocorrelation);
    case ObservableKind::StructureFactor:
      return std::make_unique<StructureFactor<D>>(simulation, measure.structure_factor);
    case ObservableKind::Clusters:
      return std::make_unique<Clusters<D>>(simulation, measure.clusters);
    case ObservableKind::BondOrder:
      return make_bond_order(simulation, measure.bond_order);
    case ObservableKind::WallPower:
      return std::make_unique<WallPower<D>>(simulation, measure.wall_power);
    case ObservableKind::PlaneCurrent:
      return std::make_unique<PlaneCurrent<D>>(simulation, measure.plane_current);
    case ObservableKind::LocalDensity:
      return std::make_unique<LocalDensity<D>>(simulation, measure.local_density);
    case ObservableKind::SpinDistribution:
      return std::make_unique<SpinDistribution<D>>(simulation, measure.spin_distribution);
    case ObservableKind::Probe:
      return std::make_unique<Probe<D>>(simulation, measure.probe);
    case ObservableKind::CollisionCounts:
      return std::make_unique<CollisionCounts<D>>(simulation);
    case ObservableKind::RadialDistributionProfile:
      return std::make_unique<RadialDistributionProfile<D>>(simulation,
                                                            measure.radial_distribution_profile);
    case ObservableKind::Mixing:
      return std::make_unique<SpeciesMixing<D>>(simulation, measure.mixing);
  }
  return nullptr;
}

template <int D>
Observables<D>::Observables(Simulation<D>& simulation, const Measure& measure)
    : simulation_(simulation) {
  for (const ObservableKind kind : measure.observables) {
    parts_.push_back(
        {make_observable(kind, simulation, measure), measure.sampling_interval(kind), {}, {}});
  }
}

template <int D>
void Observables<D>::start() {
  started_ = true;
  for (Part& part : parts_) part.observable->start();
}

template <int D>
void Observables<D>::add_timers(Timers<D>& timers, double begin) {
  for (Part& part : parts_) {
    if (!part.interval) continue;
    timers.every(
        begin + *part.interval, *part.interval,
        [this, &part](double) {
          ++part.samples;
          // An interval below the rounding of `begin` has its first samples at `begin`.
          if (started_) part.observable->sample();
        },
        part.samples);
  }
}

template <int D>
void Observables<D>::close_window() {
  for (Part& part : parts_) {
    ObservableSums window = part.observable->close_window();
    const auto means = window.values.begin() + static_cast<long>(part.observable->mean_size());
    part.fine.add({{window.values.begin(), means}});
    part.coarse.add(std::move(window));
  }
}

template <int D>
std::vector<ObservableResult> Observables<D>::results() const {
  std::vector<ObservableResult> results;
  for (const Part& part : parts_) {
    results.push_back(part.observable->result({part.fine.parts(), part.coarse.parts()}));
  }
  return results;
}

template <int D>
void Observables<D>::save(ArchiveWriter& io) {
  for (Part& part : parts_) {
    io(part.fine, part.coarse, part.samples);
    part.observable->save(io);
  }
}

template <int D>
void Observables<D>::restore(ArchiveReader& io, double begin) {
  started_ = true;
  for (Part& part : parts_) {
    io(part.fine, part.coarse, part.samples);
    io.require(!part.interval ||
               !simulation_.is_overdue(begin + *part.interval, *part.interval, part.samples));
    for (const ObservableSums& sums : part.fine.parts()) {
      io.require(sums.values.size() == part.observable->mean_size());
    }
    for (const ObservableSums& sums : part.coarse.parts()) {
      io.require(sums.values.size() == part.observable->size());
    }
    part.observable->restore(io);
  }
}

std::vector<std::string> observable_tables() {
  std::vector<std::string> names = {"radial_distribution",
                                    "radial_distribution_profile",
                                    "velocity_distribution",
                                    "velocity_distribution.speed",
                                    "velocity_distribution.tails",
                                    "free_flights.time",
                                    "free_flights.path",
                                    "collisions.impact_parameter",
                                    "collisions.normal_speed",
                                    "collisions.tangential_speed",
                                    "collisions.energy_loss",
                                    "collision_counts.particle",
                                    "collision_counts.pair",
                                    "mean_squared_displacement",
                                    "velocity_autocorrelation",
                                    "structure_factor",
                                    "clusters.size",
                                    "clusters.growth",
                                    "bond_order",
                                    "wall_power.total",
                                    "plane_current.number",
                                    "local_density.number",
                                    "probe.series",
                                    "mixing.series",
                                    "spin_distribution.components",
                                    "spin_distribution.cosine"};
  for (const char* side : kSideNames) {
    names.push_back(std::string("wall_power.") + side);
    for (const char* speeds : {".incoming", ".outgoing"}) {
      names.push_back(std::string("wall_hits.") + side + speeds);
    }
  }
  return names;
}

double observables_memory(const Scene& scene) {
  const Measure& measure = scene.measure;
  const int dimension = scene.dimension();
  const auto particles = static_cast<double>(final_count(scene));
  constexpr double kFine = PartSums<ObservableSums, 1024>::kMaxParts + 1.0;
  constexpr double kCoarse = PartSums<ObservableSums>::kMaxParts + 1.0;
  constexpr double kBins = LogBins::kCount + 64.0;  // and the sums of means
  const auto sums = [&](double size, double mean_size) {
    return (kCoarse * size + kFine * mean_size) * sizeof(double);
  };
  // A copy of the state, and the working memory of a sample.
  const double sample = (4.0 * dimension + 4.0) * sizeof(double) * particles;
  const auto history = [&](const TimeCorrelationSettings& settings, double row) {
    const LagHistory<2> lags(settings);
    const auto stored = static_cast<double>(lags.capacity());
    return stored * dimension * sizeof(double) * particles +
           sums(static_cast<double>(lags.lags().size()) * row, 0.0) + sample;
  };
  double bytes = 0.0;
  const double groups = 1.0 + static_cast<double>(scene.species.size());
  const double pairs = 1.0 + 0.5 * groups * (groups - 1.0);  // of groups, and all
  for (const ObservableKind kind : measure.observables) {
    switch (kind) {
      case ObservableKind::RadialDistribution:
        bytes += sums(pairs * (measure.radial_distribution.bins + 1.0) + 1.0, 1.0 + pairs) + sample;
        break;
      case ObservableKind::VelocityDistribution:
        bytes +=
            sums(dimension * (groups * measure.velocity_distribution.bins + 2.0 * kBins) + kBins,
                 9.0 + 3.0 * groups) +
            dimension * sizeof(double) * particles;
        if (measure.velocity_distribution.region.lower ||
            measure.velocity_distribution.region.upper) {
          bytes += sample;
        }
        break;
      case ObservableKind::SpinDistribution:
        bytes += sums(dimension * measure.spin_distribution.bins + 54.0, 4.0) + sample;
        break;
      case ObservableKind::FreeFlights:
        bytes += sums(2.0 * kBins, 3.0) + 2.0 * sizeof(double) * particles;
        break;
      case ObservableKind::Collisions:
        bytes += sums(3.0 * kBins, 9.0) + sizeof(std::uint32_t) * particles;
        break;
      case ObservableKind::WallHits:
        bytes += 2.0 * dimension * sums(2.0 * kBins, 3.0);
        break;
      case ObservableKind::MeanSquaredDisplacement:
        bytes += history(measure.mean_squared_displacement, 1.0 + 2.0 * dimension * groups);
        break;
      case ObservableKind::VelocityAutocorrelation:
        bytes += history(measure.velocity_autocorrelation, 1.0 + dimension * groups);
        break;
      case ObservableKind::StructureFactor:
        bytes += sums(pairs * measure.structure_factor.bins + 1.0, 0.0) + sample;
        break;
      case ObservableKind::Clusters:
        bytes += sums(CountBins::kCount + 5.0, 5.0) + 2.0 * sample;
        break;
      case ObservableKind::BondOrder:
        bytes += history(measure.bond_order.lags_in_time, 2.0) + sums(3.0, 3.0) + sample;
        break;
      case ObservableKind::WallPower:
        bytes += (2.0 * dimension + 1.0) * sums(SignedLogBins::kCount + 3.0, 3.0);
        break;
      case ObservableKind::PlaneCurrent:
        bytes += sums(SignedCountBins::kCount + 3.0, 3.0) + 2.0 * sample;
        break;
      case ObservableKind::LocalDensity:
        bytes += sums(CountBins::kCount + 3.0, 3.0) + sample +
                 sizeof(std::uint32_t) * measure.local_density.number_of_cells(scene.box);
        break;
      case ObservableKind::Probe:
        bytes += sums(10.0, 10.0) + sample + Probe<3>::kRows * (10.0 + 6.0) * sizeof(double);
        break;
      case ObservableKind::CollisionCounts:
        bytes += sums(2.0 * CountBins::kCount + 5.0, 5.0) + CollisionCounts<3>::memory(particles);
        break;
      case ObservableKind::RadialDistributionProfile: {
        const RadialProfileSettings& profile = measure.radial_distribution_profile;
        bytes += sums(profile.slabs * (profile.bins + 1.0) + 1.0, 0.0) + sample;
        break;
      }
      case ObservableKind::Mixing:
        bytes += sums(5.0, 5.0) + sample +
                 sizeof(std::uint32_t) * measure.mixing.number_of_cells(scene.box) *
                     static_cast<double>(scene.species.size());
        break;
    }
  }
  return bytes;
}

template class Observables<2>;
template class Observables<3>;

}  // namespace clatter
