#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/bench_fields.h"
#include "app/bench_render.h"
#include "app/bench_window.h"
#include "app/commands.h"
#include "app/flag_checks.h"
#include "app/resources.h"
#include "app/write_file.h"
#include "engine/publish/scheduled_run.h"

namespace clatter {

namespace {

struct BenchOptions {
  std::string name = "engine";
  std::string json;
  int count = 0;               // of disks of a part of the table; 0: the whole table
  double area_fraction = 0.5;  // of that cell
  double duration = 10000.0;   // simulated time of each run for the fields' table
};

// What one cell of the engine's table shows.
struct EngineRate {
  int count;
  double area_fraction;
  double rate;            // millions of disk-disk collisions per CPU second, best of three
  double setup_seconds;   // CPU time to build the start state and the simulation
  double bytes_per_disk;  // peak resident size less that before the state was built
};

// Elastic disks in a periodic square box, in equilibrium.
EngineRate measure_engine(int count, double area_fraction) {
  constexpr std::uint64_t kEquilibration = 10;  // collisions per disk
  constexpr int kRepetitions = 3;
  Scene scene;
  scene.disks.count = count;
  scene.box.setConstant(std::sqrt(count * 0.25 * std::numbers::pi / area_fraction));
  restart_peak_memory();
  const std::uint64_t memory_before = peak_memory_bytes();
  const double setup_began = cpu_seconds();
  const auto simulation = simulation_of(scene, 1);
  EngineRate result{count, area_fraction, 0.0, cpu_seconds() - setup_began, 0.0};
  const auto disks = static_cast<std::uint64_t>(count);
  simulation->run_until(kNever, kEquilibration * disks / 2);
  const std::uint64_t batch = std::max<std::uint64_t>(1'000'000, disks);
  for (int k = 0; k < kRepetitions; ++k) {
    const double began = cpu_seconds();
    simulation->run_until(kNever, simulation->counts().disk_disk + batch);
    const double rate = 1e-6 * static_cast<double>(batch) / (cpu_seconds() - began);
    result.rate = std::max(result.rate, rate);
  }
  result.bytes_per_disk =
      static_cast<double>(peak_memory_bytes() - memory_before) / static_cast<double>(count);
  return result;
}

int bench_engine(const BenchOptions& options) {
  std::vector<std::pair<int, double>> cells;
  if (options.count > 0) {
    cells = {{options.count, options.area_fraction}};
  } else {
    for (const double area_fraction : {0.1, 0.3, 0.5, 0.7}) {
      for (const int count : {1'000, 10'000, 100'000, 1'000'000})
        cells.emplace_back(count, area_fraction);
    }
  }
  std::fprintf(stderr,
               "elastic disks, periodic box; Mcoll/s: 10^6 disk-disk collisions per CPU second\n");
  std::printf("%10s %6s %9s %9s %11s\n", "N", "phi", "Mcoll/s", "setup s", "bytes/disk");
  auto json = nlohmann::ordered_json::array();
  for (const auto& [count, area_fraction] : cells) {
    const EngineRate r = measure_engine(count, area_fraction);
    std::printf("%10d %6.3f %9.3f %9.3f %11.0f\n", r.count, r.area_fraction, r.rate,
                r.setup_seconds, r.bytes_per_disk);
    std::fflush(stdout);
    json.push_back({{"count", r.count},
                    {"area_fraction", r.area_fraction},
                    {"million_collisions_per_cpu_second", r.rate},
                    {"setup_seconds", r.setup_seconds},
                    {"bytes_per_disk", r.bytes_per_disk}});
  }
  if (!options.json.empty()) write_file(options.json, json.dump(1) + "\n");
  return kOk;
}

}  // namespace

void add_bench_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = program.add_subcommand("bench", "Print performance tables");
  command
      ->add_option("name", options->name,
                   "Which table: engine, how fast collisions are; fields, what they cost; render, "
                   "what a frame costs; window, what a picture of it costs beside the drawing")
      ->check(CLI::IsMember({"engine", "fields", "render", "window"}))
      ->capture_default_str();
  command->add_option("--json", options->json, "Write the table to a file, too")->type_name("FILE");
  command
      ->add_option(
          "--count", options->count,
          "One cell of the engine's table, one number of disks of those of render and window")
      ->check(CLI::Range(2, 100'000'000));
  command
      ->add_option("--area-fraction", options->area_fraction, "One cell of the engine's table: phi")
      ->check(number_between(1e-6, 0.9))
      ->capture_default_str();
  command
      ->add_option("--duration", options->duration,
                   "Simulated time of each run for the fields' table")
      ->check(positive_number())
      ->capture_default_str();
  command->callback([options, &exit_code] {
    if (options->name == "fields") {
      exit_code = bench_fields(options->duration, options->json);
    } else if (options->name == "render") {
      exit_code = bench_render(options->json, options->count);
    } else if (options->name == "window") {
      exit_code = bench_window(options->json, options->count);
    } else {
      exit_code = bench_engine(*options);
    }
  });
}

}  // namespace clatter
