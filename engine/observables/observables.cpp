#include "engine/observables/observables.h"

#include <cmath>

#include "engine/observables/collision_statistics.h"
#include "engine/observables/free_flights.h"
#include "engine/observables/radial_distribution.h"
#include "engine/observables/time_correlation.h"
#include "engine/observables/velocity_distribution.h"
#include "engine/observables/wall_hits.h"

namespace clatter {

template <int D>
static std::unique_ptr<Observable> make_observable(ObservableKind kind, Simulation<D>& simulation,
                                                   const Measure& measure) {
  switch (kind) {
    case ObservableKind::RadialDistribution:
      return std::make_unique<RadialDistribution<D>>(simulation, measure.radial_distribution);
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
  }
  return nullptr;
}

template <int D>
Observables<D>::Observables(Simulation<D>& simulation, const Measure& measure)
    : simulation_(simulation) {
  for (const ObservableKind kind : measure.observables) {
    parts_.push_back(
        {make_observable(kind, simulation, measure), measure.sampling_interval(kind), {}});
  }
}

template <int D>
void Observables<D>::start() {
  for (Part& part : parts_) part.observable->start();
}

template <int D>
void Observables<D>::add_timers(double begin) {
  for (Part& part : parts_) {
    if (!part.interval) continue;
    simulation_.every(
        begin + *part.interval, *part.interval,
        [&part](double) {
          ++part.samples;
          part.observable->sample();
        },
        part.samples);
  }
}

template <int D>
void Observables<D>::close_window() {
  for (Part& part : parts_) part.sums.add(part.observable->close_window());
}

template <int D>
std::vector<ObservableResult> Observables<D>::results() const {
  std::vector<ObservableResult> results;
  for (const Part& part : parts_) results.push_back(part.observable->result(part.sums.parts()));
  return results;
}

template <int D>
void Observables<D>::save(ArchiveWriter& io) {
  for (Part& part : parts_) {
    io(part.sums, part.samples);
    part.observable->save(io);
  }
}

template <int D>
void Observables<D>::restore(ArchiveReader& io) {
  for (Part& part : parts_) {
    io(part.sums, part.samples);
    part.observable->restore(io);
  }
}

std::vector<std::string> observable_tables() {
  std::vector<std::string> names = {"radial_distribution",         "velocity_distribution",
                                    "free_flights.time",           "free_flights.path",
                                    "collisions.impact_parameter", "collisions.normal_speed",
                                    "collisions.tangential_speed", "collisions.energy_loss",
                                    "mean_squared_displacement",   "velocity_autocorrelation"};
  for (const char* side : kSideNames) {
    for (const char* speeds : {".incoming", ".outgoing"}) {
      names.push_back(std::string("wall_hits.") + side + speeds);
    }
  }
  return names;
}

double observables_memory(const Measure& measure, int dimension, double particles) {
  constexpr double kParts = PartSums<ObservableSums>::kMaxParts + 1.0;
  constexpr double kEventSums = 8192.0;  // more than any observable of events has
  const auto sums = [&](double count) { return kParts * count * sizeof(double); };
  const auto history = [&](const TimeCorrelationSettings& settings) {
    const double levels =
        1.0 + std::floor(std::log(std::fmax(1.0, settings.longest / settings.interval)) /
                         std::log(settings.lags));
    const double lags = levels * settings.lags;
    return lags * dimension * particles * sizeof(double) + sums(lags * (1.0 + 2.0 * dimension));
  };
  double bytes = 0.0;
  for (const ObservableKind kind : measure.observables) {
    switch (kind) {
      case ObservableKind::RadialDistribution:
        bytes += sums(measure.radial_distribution.bins);
        break;
      case ObservableKind::VelocityDistribution:
        bytes += sums(dimension * measure.velocity_distribution.bins);
        break;
      case ObservableKind::FreeFlights:
      case ObservableKind::Collisions:
      case ObservableKind::WallHits:
        bytes += sums(kEventSums);
        break;
      case ObservableKind::MeanSquaredDisplacement:
        bytes += history(measure.mean_squared_displacement);
        break;
      case ObservableKind::VelocityAutocorrelation:
        bytes += history(measure.velocity_autocorrelation);
        break;
    }
  }
  return bytes;
}

template class Observables<2>;
template class Observables<3>;

}  // namespace clatter
