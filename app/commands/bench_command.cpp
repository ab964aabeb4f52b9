#include <CLI/CLI.hpp>

#include "app/bench/accuracy.h"
#include "app/bench/engine.h"
#include "app/bench/features.h"
#include "app/bench/fields.h"
#include "app/bench/render.h"
#include "app/bench/window.h"
#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"

namespace clatter {

namespace {

// Flags of tables that have no options of their own.
struct TableOptions {
  std::string json;
  std::string plot;
  int count = 0;  // of disks; 0: the table's own
  double area_fraction = 0.5;
  double duration = 10000.0;  // simulated time of each run
};

void add_json_flag(CLI::App& table, std::string& json) {
  table.add_option("--json", json, "Write the table to a file, too")->type_name("FILE");
}

CLI::Option* add_count_flag(CLI::App& table, int& count, const char* help) {
  return table.add_option("--count", count, help)->check(CLI::Range(2, 100'000'000));
}

void add_plot_flag(CLI::App& table, std::string& plot, const char* help) {
  table.add_option("--plot", plot, help)->type_name("FILE.png");
}

void add_duration_flag(CLI::App& table, double& duration) {
  table.add_option("--duration", duration, "Simulated time of each run")
      ->check(positive_number())
      ->capture_default_str();
}

void add_engine_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table = bench.add_subcommand(
      "engine", "How fast collisions are, by number of disks and area fraction; of no table named");
  add_json_flag(*table, options->json);
  CLI::Option* count = add_count_flag(*table, options->count, "Only the cell of so many disks");
  table->add_option("--area-fraction", options->area_fraction, "Area fraction phi of that cell")
      ->check(number_between(1e-6, 0.9))
      ->needs(count)
      ->capture_default_str();
  table->callback([options, &exit_code] {
    exit_code = bench_engine(options->json, options->count, options->area_fraction);
  });
}

void add_growth_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table = bench.add_subcommand(
      "growth", "How that falls with the number of disks and their density, and in clusters");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Largest number of disks (default: 4000000)");
  add_plot_flag(*table, options->plot, "Draw the table, too");
  table->callback([options, &exit_code] {
    exit_code = bench_growth(options->json, options->plot, options->count);
  });
}

void add_features_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table =
      bench.add_subcommand("features", "What each thing that a scene adds takes of that");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Number of disks (default: 1000)");
  table->callback(
      [options, &exit_code] { exit_code = bench_features(options->json, options->count); });
}

void add_fields_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table = bench.add_subcommand("fields", "What fields cost and how precise they are");
  add_json_flag(*table, options->json);
  add_duration_flag(*table, options->duration);
  table->callback(
      [options, &exit_code] { exit_code = bench_fields(options->duration, options->json); });
}

void add_render_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table = bench.add_subcommand("render", "What a frame of film costs");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Only this number of disks");
  table->callback(
      [options, &exit_code] { exit_code = bench_render(options->json, options->count); });
}

void add_window_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<TableOptions>();
  CLI::App* table =
      bench.add_subcommand("window", "What a picture of the window costs beside the drawing");
  add_json_flag(*table, options->json);
  add_count_flag(*table, options->count, "Number of disks (default: 10000)");
  table->callback(
      [options, &exit_code] { exit_code = bench_window(options->json, options->count); });
}

void add_accuracy_table(CLI::App& bench, int& exit_code) {
  auto options = std::make_shared<AccuracyBench>();
  CLI::App* table =
      bench.add_subcommand("accuracy", "What each dial costs and how far off the finest it is");
  table->add_option("scene", options->scene, "Path or gallery name")
      ->capture_default_str()
      ->type_name("SCENE");
  add_json_flag(*table, options->json);
  add_duration_flag(*table, options->duration);
  table->add_option("--dial", options->dials, "This dial alone; may be given again")
      ->type_name("NAME")
      ->take_all();
  table->add_option("--csv", options->csv, "Write the tables as CSV, too")->type_name("FILE");
  add_plot_flag(*table, options->plot, "Draw cost against error");
  table
      ->add_option("--markdown", options->markdown,
                   "Put the tables between the lines <!-- tables --> and <!-- end of tables --> of "
                   "a page")
      ->type_name("FILE.md");
  table->callback([options, &exit_code] { exit_code = bench_accuracy(*options); });
}

}  // namespace

void add_bench_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("bench", "Print performance tables");
  command->require_subcommand(1);
  add_engine_table(*command, exit_code);
  add_growth_table(*command, exit_code);
  add_features_table(*command, exit_code);
  add_fields_table(*command, exit_code);
  add_render_table(*command, exit_code);
  add_window_table(*command, exit_code);
  add_accuracy_table(*command, exit_code);
}

}  // namespace clatter
