#include <fmt/format.h>
#include <fmt/printf.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/bench/tables.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/measure/balance.h"
#include "engine/measure/profile.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/field.h"
#include "engine/scene/scene_file.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

constexpr double kBurnIn = 200.0;
constexpr int kRepetitions = 3;

// The measurement of a run. Without fields and balance there is no observer.
struct FieldMeasurement {
  std::string name;
  std::vector<Field> fields;
  std::optional<double> interval = {};  // of snapshots; absent: exact
  bool balance = false;
};

struct Outcome {
  double cpu_seconds = 0.0;
  double collisions = 0.0;
  double variance = 0.0;  // of T, mean over the columns
};

double mean_variance(const std::vector<Estimate>& column) {
  double sum = 0.0;
  for (const Estimate& e : column) sum += e.standard_error * e.standard_error;
  return sum / static_cast<double>(column.size());
}

Outcome observe(const Scene& scene, double duration, const FieldMeasurement& how) {
  constexpr double kWindows = 512.0, kWindowsPerBalance = 32.0;
  const auto simulation = simulation_of<2>(scene, 1);
  simulation->run_until(kBurnIn);
  const auto collisions_before = static_cast<double>(simulation->counts().pair_collisions);
  const bool samples = how.interval.has_value();
  const IntVec<2> cells(scene.measure.cells[0], scene.measure.cells[1]);
  const double window = duration / kWindows;
  std::optional<Balance<2>> balance;
  if (how.balance) {
    simulation->add_observer(balance.emplace(*simulation, cells));
    const double longer = kWindowsPerBalance * window;
    simulation->every(kBurnIn + longer, longer, [&](double) { balance->close_window(); });
  }
  CellIntegrals<2> integrals(*simulation, cells, moment_layout<2>(how.fields, false, false),
                             {samples ? Estimator::Snapshot : Estimator::Exact, {}});
  std::vector<CellSums> windows;
  if (!how.fields.empty()) {
    simulation->add_observer(integrals);
    if (samples) {
      simulation->every(kBurnIn + *how.interval, *how.interval,
                        [&](double) { integrals.sample(); });
    }
    simulation->every(kBurnIn + window, window, [&](double) {
      windows.push_back(columns_of(integrals.close_window(), integrals.grid(), Axis::X));
    });
  }
  const double began = cpu_seconds();
  simulation->run_until(kBurnIn + duration);
  Outcome outcome;
  outcome.cpu_seconds = cpu_seconds() - began;
  outcome.collisions =
      static_cast<double>(simulation->counts().pair_collisions) - collisions_before;
  if (!how.fields.empty()) {
    const Profile profile =
        profile_of(windows, integrals.grid(), integrals.layout(), how.fields, Axis::X);
    outcome.variance = mean_variance(profile.at(Quantity::Temperature));
  }
  return outcome;
}

// Runs all settings in turn, repeatedly, so that the load of the machine affects them equally. The
// least time counts.
std::vector<Outcome> observe_all(const Scene& scene, double duration,
                                 const std::vector<FieldMeasurement>& ways) {
  std::vector<Outcome> outcomes(ways.size());
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    for (std::size_t k = 0; k < ways.size(); ++k) {
      const Outcome outcome = observe(scene, duration, ways[k]);
      const double best = outcomes[k].cpu_seconds;
      outcomes[k] = outcome;
      if (repetition > 0) outcomes[k].cpu_seconds = std::min(best, outcome.cpu_seconds);
    }
  }
  return outcomes;
}

// All averages of a smooth gas.
std::vector<Field> averages_without_spins() {
  std::vector<Field> fields = all_fields(2);
  std::erase_if(fields, [](Field field) { return of_spins(field) || is_residual(field); });
  return fields;
}

}  // namespace

int bench_fields(double duration, const std::string& json) {
  Scene scene = load_scene("vibrated", {});
  scene.measure.cells = {20, 25};  // cells of one diameter
  const std::vector<Field> temperature = {Quantity::Temperature};
  std::vector<FieldMeasurement> ways = {
      {"bare run", {}}, {"exact, all fields", averages_without_spins()}, {"exact", temperature}};
  for (const double interval : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    ways.push_back({fmt::format("snapshot {:g}", interval), temperature, interval});
  }
  ways.push_back({.name = "balance", .fields = {}, .balance = true});
  std::fprintf(stderr,
               "vibrated scene, cells of one diameter, %g time units; the second row measures all "
               "fields, the last row all balance equations, the others T\ncost: CPU time relative "
               "to a bare run; variance: of the profile of T, mean over its columns\n",
               duration);
  const std::vector<Outcome> outcomes = observe_all(scene, duration, ways);
  const Outcome& bare = outcomes.front();
  print(fmt::sprintf("%-18s %8s %13s %12s %16s\n", "estimator", "cost", "ns/collision", "variance",
                     "cost x variance"));
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const Outcome& outcome = outcomes[k];
    const double cost = outcome.cpu_seconds / bare.cpu_seconds;
    const double added = 1e9 * (outcome.cpu_seconds - bare.cpu_seconds) / outcome.collisions;
    print(fmt::sprintf("%-18s %8.3f %13.1f", ways[k].name.c_str(), cost, added));
    nlohmann::ordered_json row = {
        {"estimator", ways[k].name}, {"cost", cost}, {"added_nanoseconds_per_collision", added}};
    if (!ways[k].fields.empty()) {
      print(fmt::sprintf(" %12.3e %16.3e", outcome.variance, cost * outcome.variance));
      row["variance"] = outcome.variance;
      row["cost_times_variance"] = cost * outcome.variance;
    }
    print("\n");
    rows.push_back(row);
  }
  if (!json.empty()) write_file(json, rows.dump(1) + "\n");
  return kOk;
}

}  // namespace clatter
