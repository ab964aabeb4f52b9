#include "app/bench/cores.h"

#include <fmt/format.h>
#include <fmt/printf.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/bench/tables.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/run/scheduled_run.h"
#include "engine/system/allocation.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

using Json = nlohmann::ordered_json;

template <int D>
CoresRate measure_rate(const Model<D>& model, const RunState<D>& start, double fraction,
                       int threads, std::uint64_t collisions) {
  Simulation<D> simulation(model, start);
  if (threads > 0) {
    simulation.use_threads(threads, tile_sizes(start.flights.size(), fraction, threads));
    if (!simulation.foresight()) return {};
  }
  const auto began = std::chrono::steady_clock::now();
  const double cpu_before = cpu_seconds();
  simulation.run_until(kNever, simulation.counts().collisions() + collisions);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
  CoresRate result{.threads = threads,
                   .rate = 1e-6 * static_cast<double>(collisions) / elapsed.count(),
                   .hash = simulation.state_hash()};
  if (threads > 0) {
    const auto& work = simulation.foresight()->work();
    const auto own = static_cast<double>(std::max<std::uint64_t>(work.own, 1));
    result.busy = (cpu_seconds() - cpu_before) / (threads * elapsed.count());
    result.redundant = static_cast<double>(work.all) / own - 1.0;
    result.redone = static_cast<double>(work.redone) / static_cast<double>(work.tiles);
  }
  return result;
}

// The rates of a gas as a whole and with up to `most` threads, from the same state.
template <int D>
std::vector<CoresRate> measure_gas(const Scene& scene, int most) {
  constexpr std::uint64_t kEquilibration = 5, kMeasured = 10;  // collisions of a pair per particle
  const auto particles = static_cast<std::uint64_t>(scene.particles.count);
  const auto simulation = simulation_of<D>(scene, 1);
  simulation->use_threads(most);
  simulation->run_until(kNever, kEquilibration * particles);
  const std::uint64_t batch = std::max<std::uint64_t>(2'000'000, kMeasured * particles);
  const RunState<D> start = simulation->save();
  const double fraction = scene.packing_fraction();
  std::vector<CoresRate> rates = {measure_rate<D>(simulation->model(), start, fraction, 0, batch)};
  for (int threads = 1;; threads = std::min(2 * threads, most)) {
    rates.push_back(measure_rate<D>(simulation->model(), start, fraction, threads, batch));
    if (rates.back().rate == 0.0) {
      rates.pop_back();
    } else if (rates.back().hash != rates.front().hash) {
      throw RunError("the state hash depends on the number of threads");
    }
    if (threads == most) return rates;
  }
}

}  // namespace

std::vector<EngineCell> cores_cells(const CoresTable& table) {
  if (table.area_fraction) {
    if (!has_room(table.count, *table.area_fraction, 2)) {
      throw UserError({"--area-fraction", 0, 0},
                      "no square box holds this number of disks at this fraction",
                      "choose a smaller fraction, or another --count");
    }
    return {{table.count, *table.area_fraction}};
  }
  std::vector<EngineCell> cells;
  for (const int count : {100'000, 1'000'000, 10'000'000}) {
    if (table.count > 0 && count > table.count) continue;
    for (const double phi : {0.1, 0.3, table.dimension == 2 ? 0.5 : 0.45, 0.7}) {
      if (has_room(count, phi, table.dimension)) cells.emplace_back(count, phi);
    }
  }
  return cells;
}

Plot cores_plot(int dimension, const std::vector<CoresRate>& rates) {
  Plot plot{.title = "Collision rate on several threads",
            .caption = fmt::format("Elastic {} in a periodic box; the smallest number of threads: "
                                   "the gas as a whole",
                                   dimension == 2 ? "disks" : "spheres"),
            .x_name = "threads",
            .y_name = "million collisions per second",
            .panels = {}};
  for (const CoresRate& rate : rates) {
    const bool whole = rate.threads == 0;
    if (whole) {
      plot.panels.push_back({fmt::format("N = {}, phi = {:g}", rate.count, rate.fraction), {}});
    }
    plot.panels.back().points.push_back({whole ? 0.5 : static_cast<double>(rate.threads), rate.rate,
                                         fmt::format("{:.2f}", rate.rate), false});
  }
  return plot;
}

int bench_cores(const std::string& json, const std::string& plot_file, const CoresTable& table) {
  if (!plot_file.empty()) require_writable_file(plot_file, "--plot");
  const int most = table.threads > 0 ? table.threads : processors();
  const bool disks = table.dimension == 2;
  const std::vector<EngineCell> cells = cores_cells(table);
  std::fprintf(stderr, "elastic %s, periodic box; Mcoll/s: 10^6 pair collisions per second\n",
               disks ? "disks" : "spheres");
  print(fmt::sprintf("%10s %6s %8s %9s %9s %6s %10s %7s\n", "N", "phi", "threads", "Mcoll/s",
                     "of whole", "busy", "redundant", "redone"));
  Json rows = Json::array();
  std::vector<CoresRate> all;
  for (const auto& [count, phi] : cells) {
    const Scene scene = elastic_gas(count, phi, table.dimension);
    const std::vector<CoresRate> rates = with_dimension(
        table.dimension, [&](auto dimension) { return measure_gas<dimension>(scene, most); });
    for (CoresRate rate : rates) {
      rate.count = count;
      rate.fraction = phi;
      all.push_back(rate);
      const double of_whole = rate.rate / rates.front().rate;
      const bool whole = rate.threads == 0;
      print(fmt::sprintf("%10d %6.3f %8s %9.3f %9.2f %6.2f %10.2f %7.3f\n", count, phi,
                         whole ? "whole" : std::to_string(rate.threads).c_str(), rate.rate,
                         of_whole, rate.busy, rate.redundant, rate.redone));
      rows.push_back({{"count", count},
                      {disks ? "area_fraction" : "volume_fraction", phi},
                      {"threads", rate.threads},
                      {"million_collisions_per_second", rate.rate},
                      {"of_whole", of_whole},
                      {"busy", rate.busy},
                      {"redundant", rate.redundant},
                      {"redone", rate.redone}});
    }
  }
  if (!json.empty()) write_file(json, rows.dump(1) + "\n");
  if (!plot_file.empty()) write_plot(plot_file, cores_plot(table.dimension, all));
  return kOk;
}

}  // namespace clatter
