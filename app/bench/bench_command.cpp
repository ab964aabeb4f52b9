#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/bench/accuracy.h"
#include "app/bench/features.h"
#include "app/bench/fields.h"
#include "app/bench/render.h"
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
  double duration = 0.0;       // simulated time of each run; 0: the table's own
  AccuracyBench accuracy;
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

void add_accuracy_options(CLI::App& command, AccuracyBench& accuracy) {
  command
      .add_option("scene", accuracy.scene, "Scene of the table of accuracy: path or gallery name")
      ->capture_default_str();
  command.add_option("--dial", accuracy.dials, "Of accuracy, this dial; may be given again")
      ->type_name("NAME")
      ->take_all();
  command.add_option("--csv", accuracy.csv, "Of accuracy: write its tables as CSV, too")
      ->type_name("FILE");
  command.add_option("--plot", accuracy.plot, "Of accuracy: draw cost against error")
      ->type_name("FILE.png");
  command
      .add_option("--markdown", accuracy.markdown,
                  "Of accuracy: put its tables between the lines <!-- tables --> and "
                  "<!-- end of tables --> of a page")
      ->type_name("FILE.md");
}

}  // namespace

void add_bench_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = program.add_subcommand("bench", "Print performance tables");
  command
      ->add_option(
          "name", options->name,
          "Which table: engine, how fast collisions are; features, what each thing that a scene "
          "adds takes of that; fields, what they cost; render, "
          "what a frame costs; accuracy, what each dial costs and how far off it is")
      ->check(CLI::IsMember({"engine", "features", "fields", "render", "accuracy"}))
      ->capture_default_str();
  command->add_option("--json", options->json, "Write the table to a file, too")->type_name("FILE");
  command
      ->add_option(
          "--count", options->count,
          "One cell of the engine's table, the number of disks of those of features and render")
      ->check(CLI::Range(2, 100'000'000));
  command
      ->add_option("--area-fraction", options->area_fraction, "One cell of the engine's table: phi")
      ->check(number_between(1e-6, 0.9))
      ->capture_default_str();
  command
      ->add_option("--duration", options->duration,
                   "Simulated time of each run (default: 10000 for fields, 1000 for accuracy)")
      ->check(positive_number());
  add_accuracy_options(*command, options->accuracy);
  command->callback([options, &exit_code] {
    if (options->name == "fields") {
      exit_code =
          bench_fields(options->duration > 0.0 ? options->duration : 10000.0, options->json);
    } else if (options->name == "accuracy") {
      options->accuracy.json = options->json;
      if (options->duration > 0.0) options->accuracy.duration = options->duration;
      exit_code = bench_accuracy(options->accuracy);
    } else if (options->name == "features") {
      exit_code = bench_features(options->json, options->count);
    } else if (options->name == "render") {
      exit_code = bench_render(options->json, options->count);
    } else {
      exit_code = bench_engine(*options);
    }
  });
}

}  // namespace clatter
