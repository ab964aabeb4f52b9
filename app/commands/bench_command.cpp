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

struct BenchOptions {
  std::string name = "engine";
  std::string json;
  int count = 0;               // of disks of a part of the table; 0: the whole table
  double area_fraction = 0.5;  // of that cell
  double duration = 0.0;       // simulated time of each run; 0: the table's own
  AccuracyBench accuracy;
};

void add_accuracy_options(CLI::App& command, AccuracyBench& accuracy) {
  command
      .add_option("scene", accuracy.scene, "Scene of the table of accuracy: path or gallery name")
      ->capture_default_str();
  command.add_option("--dial", accuracy.dials, "Of accuracy, this dial; may be given again")
      ->type_name("NAME")
      ->take_all();
  command.add_option("--csv", accuracy.csv, "Of accuracy: write its tables as CSV, too")
      ->type_name("FILE");
  command
      .add_option("--plot", accuracy.plot,
                  "Of accuracy: draw cost against error; of growth: draw it")
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
          "Which table: engine, how fast collisions are; growth, how that falls with the number "
          "of disks and their density, and in clusters; features, what each thing that a scene "
          "adds takes of that; fields, what they cost; render, "
          "what a frame costs; window, what a picture of it costs beside the drawing; accuracy, "
          "what each dial costs and how far off it is")
      ->check(
          CLI::IsMember({"engine", "growth", "features", "fields", "render", "window", "accuracy"}))
      ->capture_default_str();
  command->add_option("--json", options->json, "Write the table to a file, too")->type_name("FILE");
  command
      ->add_option(
          "--count", options->count,
          "One cell of the engine's table, the number of disks of those of features, render and "
          "window, "
          "the largest of growth")
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
    } else if (options->name == "growth") {
      exit_code = bench_growth(options->json, options->accuracy.plot, options->count);
    } else if (options->name == "features") {
      exit_code = bench_features(options->json, options->count);
    } else if (options->name == "render") {
      exit_code = bench_render(options->json, options->count);
    } else if (options->name == "window") {
      exit_code = bench_window(options->json, options->count);
    } else {
      exit_code = bench_engine(options->json, options->count, options->area_fraction);
    }
  });
}

}  // namespace clatter
