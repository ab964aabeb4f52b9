#include <CLI/CLI.hpp>

#include "app/bench/accuracy.h"
#include "app/bench/cores.h"
#include "app/bench/engine.h"
#include "app/bench/features.h"
#include "app/bench/tables.h"
#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/system/outputs.h"
#include "engine/error.h"

namespace clatter {

namespace {

// Flags of the tables without options of their own.
struct TableOptions {
  std::string json;
  std::string plot;
  int count = 0;              // of particles; 0: default of the table
  double duration = 10000.0;  // simulated time of each run
};

struct RenderTableOptions {
  TableOptions table;
  int dimension = 2;  // of the box: disks or spheres
};

struct CoresOptions {
  std::string json;
  std::string plot;
  CoresTable table;
};

struct EngineOptions {
  std::string json;
  EngineTable table;
  std::string species;
};

void add_json_flag(CLI::App& table, std::string& json) {
  table.add_option("--json", json, "File for the table as JSON.")
      ->type_name("FILE")
      ->each([](const std::string& file) { require_writable_file(file, "--json"); });
}

void add_dimension_flag(CLI::App& table, int& dimension) {
  table.add_option("--dimension", dimension, "2: disks. 3: spheres.")
      ->check(whole_number_between(2, 3))
      ->capture_default_str();
}

CLI::Option* add_count_flag(CLI::App& table, int& count, const char* help) {
  return table.add_option("--count", count, help)->check(whole_number_between(2, 100'000'000));
}

void add_plot_flag(CLI::App& table, std::string& plot, const char* help) {
  table.add_option("--plot", plot, help)->type_name("FILE.png");
}

void add_duration_flag(CLI::App& table, double& duration) {
  table.add_option("--duration", duration, "Simulation time of each run.")
      ->check(positive_number())
      ->capture_default_str();
}

void add_engine_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<EngineOptions>();
  CLI::App* table = bench.add_subcommand("engine",
                                         "Collisions per second, by number of particles and area "
                                         "or volume fraction. This is the default table.");
  add_json_flag(*table, options->json);
  CLI::Option* count = add_count_flag(*table, options->table.count,
                                      "Number of particles. The table then has one cell.");
  add_dimension_flag(*table, options->table.dimension);
  CLI::Option* area = table
                          ->add_option("--area-fraction", options->table.area_fraction,
                                       "Area fraction of that cell, of disks.")
                          ->check(number_between(1e-6, 0.9))
                          ->capture_default_str();
  CLI::Option* volume = table
                            ->add_option("--volume-fraction", options->table.volume_fraction,
                                         "Volume fraction of that cell, of spheres.")
                            ->check(number_between(1e-6, 0.74))
                            ->excludes(area);
  CLI::Option* species =
      table
          ->add_option("--species", options->species,
                       "A mixture: number, diameter and mass of the particles of each species. The "
                       "table then has one cell.")
          ->type_name("COUNT:DIAMETER:MASS,...")
          ->excludes(count);
  table->add_flag("--start-only", options->table.start_only,
                  "Measure the set-up alone: start state, lists and first events.");
  table->callback([options, count, area, volume, species, &exit_code] {
    const bool fills = area->count() + volume->count() > 0;
    if (fills && count->count() + species->count() == 0) {
      throw UserError({area->count() > 0 ? "--area-fraction" : "--volume-fraction", 0, 0},
                      "it needs --count or --species", "add one of them");
    }
    if (species->count() > 0) options->table.species = parse_species(options->species);
    exit_code = bench_engine(options->json, options->table);
  });
}

void add_growth_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table =
      bench.add_subcommand("growth", "Dependence of the speed on number, density and clusters.");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Largest number of disks. Default: 4000000.");
  add_plot_flag(*table, options->plot, "File for a plot of the table.");
  table->callback([options, &exit_code] {
    exit_code = bench_growth(options->json, options->plot, options->count);
  });
}

void add_features_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table =
      bench.add_subcommand("features", "Cost of walls, gravity, spins and other features.");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Number of disks. Default: 1000.");
  table->callback(
      [options, &exit_code] { exit_code = bench_features(options->json, options->count); });
}

void add_fields_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table = bench.add_subcommand("fields", "Cost and precision of fields.");
  add_json_flag(*table, options->json);
  add_duration_flag(*table, options->duration);
  table->callback(
      [options, &exit_code] { exit_code = bench_fields(options->duration, options->json); });
}

void add_render_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<RenderTableOptions>();
  CLI::App* table = bench.add_subcommand("render", "Cost of a frame of film.");
  add_json_flag(*table, options->table.json);
  add_count_flag(*table, options->table.count, "Number of particles. Default: several numbers.");
  add_dimension_flag(*table, options->dimension);
  table->callback([options, &exit_code] {
    exit_code = bench_render(options->table.json, options->table.count, options->dimension);
  });
}

void add_window_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table =
      bench.add_subcommand("window", "Cost of a picture in the window, without the drawing.");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Number of disks. Default: 10000.");
  table->callback(
      [options, &exit_code] { exit_code = bench_window(options->json, options->count); });
}

void add_cores_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<CoresOptions>();
  CLI::App* table = bench.add_subcommand(
      "cores", "Collisions per second of a large gas in tiles, by number of threads.");
  add_json_flag(*table, options->json);
  CLI::Option* count = add_count_flag(*table, options->table.count,
                                      "Largest number of particles. Default: 10000000.");
  add_dimension_flag(*table, options->table.dimension);
  table
      ->add_option("--area-fraction", options->table.area_fraction,
                   "The table has one cell: --count disks at this area fraction.")
      ->check(number_between(1e-6, 0.9))
      ->needs(count)
      ->excludes(table->get_option("--dimension"));
  table
      ->add_option("--threads", options->table.threads,
                   "Largest number of threads. Default: the number of processors.")
      ->check(whole_number_between(1, 256));
  add_plot_flag(*table, options->plot, "File for a plot of the table.");
  table->callback([options, &exit_code] {
    exit_code = bench_cores(options->json, options->plot, options->table);
  });
}

void add_timeline_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table = bench.add_subcommand(
      "timeline", "Time of a jump to the past of a run, and memory of the record.");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Number of disks. Default: 1000 and 20000.");
  table->callback(
      [options, &exit_code] { exit_code = bench_timeline(options->json, options->count); });
}

void add_accuracy_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<AccuracyBench>();
  CLI::App* table = bench.add_subcommand("accuracy", "Cost and error of each setting.");
  table->add_option("scene", options->scene, "A scene file, or a scene of the gallery.")
      ->capture_default_str()
      ->type_name("SCENE");
  add_json_flag(*table, options->json);
  add_duration_flag(*table, options->duration);
  table
      ->add_option("--dial", options->dials,
                   "Setting of the table. Repeatable. Default: all settings.")
      ->type_name("NAME")
      ->take_all();
  table->add_option("--csv", options->csv, "File for the tables as CSV.")->type_name("FILE");
  add_plot_flag(*table, options->plot, "File for a plot of cost against error.");
  table
      ->add_option(
          "--markdown", options->markdown,
          "Page for the tables. They replace the text between the lines <!-- tables --> and "
          "<!-- end of tables -->.")
      ->type_name("FILE.md");
  table->callback([options, &exit_code] { exit_code = bench_accuracy(*options); });
}

}  // namespace

void add_bench_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("bench", "Print performance tables.");
  command->require_subcommand(1);
  add_engine_table(*command, exit_code);
  add_growth_table(*command, exit_code);
  add_features_table(*command, exit_code);
  add_fields_table(*command, exit_code);
  add_render_table(*command, exit_code);
  add_window_table(*command, exit_code);
  add_timeline_table(*command, exit_code);
  add_accuracy_table(*command, exit_code);
  add_cores_table(*command, exit_code);
}

}  // namespace clatter
