#include "app/measure/feature_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/results/theory_json.h"
#include "engine/dimension.h"
#include "engine/initial/memory.h"
#include "engine/measure/measurement.h"
#include "engine/observables/observables.h"
#include "engine/scene/enum_names.h"
#include "engine/system/allocation.h"

namespace clatter {

namespace {

std::string yes(bool modelled) {
  return modelled ? "yes" : "no";
}

std::string names_of(const std::vector<Field>& fields, int dimension) {
  const std::vector<NamedField> all = measured_names(dimension);
  std::string names;
  std::string_view last;
  for (const Field field : fields) {
    const std::string_view name = name_of(field, all);
    if (name != last) names += (names.empty() ? "" : ", ") + std::string(name);
    last = name;
  }
  return names;
}

FeatureCost fields_of(const Scene& scene) {
  const Measure& measure = scene.measure;
  double price = cost_of(measure.estimator);
  if (measure.fields.empty()) return {"fields", "no", 0.0, price};
  if (std::ranges::any_of(measure.fields, is_residual)) {
    const bool averages = !std::ranges::all_of(measure.fields, is_residual);
    price = averages ? price + kBalanceCost - 1.0 : kBalanceCost;
  }
  return {"fields", names_of(measure.fields, scene.dimension()),
          with_dimension(scene.dimension(),
                         [&](auto dimension) {
                           return cells_memory<dimension>(measure, scene.spins(),
                                                          scene.species.size());
                         }),
          price};
}

// Price of an observable, minus 1, by `clatter bench features`. Samples are priced at one sample
// per mean free time, wall hits beside a gas with the same walls, and mixing beside the same
// mixture.
struct ObservablePrice {
  ObservableKind kind;
  double surcharge;
};
constexpr std::array<ObservablePrice, 18> kObservablePrices = {
    {{ObservableKind::RadialDistribution, 0.28},
     {ObservableKind::VelocityDistribution, 0.07},
     {ObservableKind::FreeFlights, 0.12},
     {ObservableKind::Collisions, 0.17},
     {ObservableKind::WallHits, 0.04},
     {ObservableKind::MeanSquaredDisplacement, 0.2},
     {ObservableKind::VelocityAutocorrelation, 0.08},
     {ObservableKind::StructureFactor, 11.7},
     {ObservableKind::Clusters, 0.5},
     {ObservableKind::BondOrder, 0.62},
     {ObservableKind::WallPower, 0.06},
     {ObservableKind::PlaneCurrent, 0.12},
     {ObservableKind::LocalDensity, 0.05},
     {ObservableKind::SpinDistribution, 0.19},
     {ObservableKind::Probe, 0.09},
     {ObservableKind::CollisionCounts, 0.22},
     {ObservableKind::RadialDistributionProfile, 0.74},
     {ObservableKind::Mixing, 0.08}}};

FeatureCost observables_of(const Scene& scene) {
  const Measure& measure = scene.measure;
  if (measure.observables.empty()) return {"observables", "no", 0.0, std::nan("")};
  const double rate = collision_rate(scene, scene.particles.start.temperature);
  std::string names;
  double price = 1.0;
  for (const auto& [kind, surcharge] : kObservablePrices) {
    if (!measure.observes(kind)) continue;
    names += (names.empty() ? "" : ", ") + std::string(name_of(kind, kObservables));
    const std::optional<double> interval = measure.sampling_interval(kind);
    price += interval ? surcharge / (*interval * rate) : surcharge;
  }
  return {"observables", names, observables_memory(scene), price};
}

// A kick of one disk costs about half a collision of two disks. Valid at the temperature of the
// start.
double kick_cost(const Scene& scene) {
  constexpr double kKick = 0.45;
  const double rate = collision_rate(scene, scene.particles.start.temperature);
  return 1.0 + kKick / (0.5 * rate * scene.bulk_drive->interval);
}

}  // namespace

double cost_of(Estimator estimator) {
  switch (estimator) {
    case Estimator::Exact:
      return 1.4;
    case Estimator::Snapshot:
      return 1.1;
  }
  return std::nan("");
}

std::vector<FeatureCost> feature_costs(const Scene& scene) {
  const GasMemory memory = gas_memory(scene);
  const bool moving =
      std::ranges::any_of(scene.walls, [](const auto& wall) { return wall && wall->moves(); });
  return {{"particles", "yes", memory.particles, 1.0},
          {"spins", yes(scene.spins()), memory.spins, 1.05},
          {"gravity", yes(scene.gravity.has_value()), 0.0, 1.15},
          {"moving walls", yes(moving), 0.0, 1.0},
          {"bulk drive", yes(scene.bulk_drive.has_value()), 0.0,
           scene.bulk_drive ? kick_cost(scene) : std::nan("")},
          {"t_c", yes(scene.contact_time.has_value()), memory.last_collisions, kContactTimeCost},
          fields_of(scene),
          observables_of(scene)};
}

double memory_of(const Scene& scene) {
  double bytes = 0.0;
  for (const FeatureCost& part : feature_costs(scene)) bytes += part.bytes;
  return bytes;
}

void require_room(const Scene& scene) {
  require_memory(scene);
  const double there = available_memory(), needed = memory_of(scene);
  if (needed <= there) return;
  const std::vector<FeatureCost> parts = feature_costs(scene);
  const FeatureCost& largest = *std::ranges::max_element(parts, {}, &FeatureCost::bytes);
  throw UserError({},
                  fmt::format("the scene takes about {:.3g} GB, and this process may use {:.3g} GB",
                              1e-9 * needed, 1e-9 * there),
                  fmt::format("reduce the largest part: {}, with {:.3g} GB", largest.name,
                              1e-9 * largest.bytes));
}

std::string cost_text(double price) {
  if (!std::isfinite(price)) return "-";
  return fmt::format("x{:.3g}", price);
}

}  // namespace clatter
