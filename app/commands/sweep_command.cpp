#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/commands/flags.h"
#include "app/sweep/executor.h"
#include "app/sweep/refinement.h"
#include "app/sweep/studies.h"
#include "app/sweep/submit.h"
#include "app/sweep/sweep_plot.h"
#include "app/sweep/sweep_table.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/error.h"
#include "engine/system/allocation.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

struct SweepOptions {
  CommonOptions common;  // --quiet and --progress only
  std::string file;
  std::string folder;
  std::optional<int> threads;
  std::vector<std::string> ids;
  bool prepare = false;
};

// First and last number of each part of words such as 17 and 20-25,30.
std::vector<std::pair<int, int>> ids_of(const std::vector<std::string>& words) {
  std::vector<std::pair<int, int>> ids;
  for (const std::string& word : words) {
    for (std::size_t begin = 0; begin <= word.size();) {
      const std::size_t end = std::min(word.find(',', begin), word.size());
      const std::string part = word.substr(begin, end - begin);
      const std::size_t dash = std::min(part.find('-'), part.size());
      const auto first = whole_number<int>(part.substr(0, dash));
      const auto last = dash == part.size() ? first : whole_number<int>(part.substr(dash + 1));
      if (!first || !last || *first < 1 || *last < *first) {
        throw UserError({"ID", 0, 0}, "'" + part + "' is no run",
                        "give numbers such as 17 or 20-25");
      }
      ids.emplace_back(*first, *last);
      begin = end + 1;
    }
  }
  return ids;
}

void note_omitted_points(const SweepFolder& folder, const Sweep& sweep) {
  for (const SweepPoint& point : points_without_goal(folder, sweep)) {
    std::fprintf(stderr, "note: the results at %s have no mean '%s'; the refinement omits them\n",
                 settings_text(point).c_str(), sweep.accuracy.of.c_str());
  }
}

// Measures the open runs of a sweep, and then the points of its refinement.
int measure_sweep(const SweepFolder& folder, const SweepOptions& options) {
  const Sweep sweep = folder.sweep();
  while (true) {
    const int processes =
        options.threads ? *options.threads : fitting_processors(run_memory(folder));
    const int code = execute_sweep(folder, processes, options.common.shown_progress());
    if (code == kInterrupted || !sweep.refinement) return code;
    const std::vector<SweepPoint> points = refined_points(folder, sweep);
    if (points.empty()) {
      if (!options.common.quiet) note_omitted_points(folder, sweep);
      return code;
    }
    folder.add(points, sweep.seeds);
  }
}

// Whether any point can be drawn.
bool has_points(const Chart& chart) {
  const auto fits = [](double value, bool logarithmic) {
    return std::isfinite(value) && (value > 0.0 || !logarithmic);
  };
  return std::ranges::any_of(chart.series, [&](const ChartSeries& series) {
    return std::ranges::any_of(series.points, [&](const ChartPoint& point) {
      return fits(point.x, chart.x.logarithmic) && fits(point.y, chart.y.logarithmic);
    });
  });
}

void write_study_charts(const SweepFolder& folder, const SweepTable& table, const Study& study) {
  for (const StudyChart& chart : study.charts) {
    const Chart drawn = chart_of(table, folder.sweep().axes(), chart.plot);
    for (const char* suffix : {".png", ".svg"}) {
      write_chart(folder.path() / (chart.name + suffix), drawn);
    }
  }
}

// Measures all runs, even after a failure. The exit code is that of the last failure.
int measure_runs(const SweepOptions& options) {
  SweepFolder folder(options.folder);
  int code = kOk;
  for (const auto& [first, last] : ids_of(options.ids)) {
    for (int id = first; id <= last; ++id) {
      const int ended = measure_run(folder, id, options.common.shown_progress());
      if (ended == kInterrupted) return kInterrupted;
      if (ended != kOk) code = ended;
    }
  }
  return code;
}

void add_folder(CLI::App& command, std::string& folder) {
  command.add_option("folder", folder, "Folder of a sweep.")->required()->type_name("DIR");
}

void add_quiet_and_progress(CLI::App& command, CommonOptions& options) {
  command.add_flag("--quiet", options.quiet, "Print errors only on stderr.");
  add_progress_flag(command, options);
}

// --out, --threads, --quiet, --progress.
void add_execution_flags(CLI::App& command, SweepOptions& options) {
  command.add_option("--out", options.folder, "Folder of the sweep.")
      ->required()
      ->check(named_file())
      ->type_name("DIR");
  command
      .add_option("--threads", options.threads,
                  "Number of runs at once. Default: the number of processors, or fewer if the "
                  "memory has room for fewer.")
      ->check(whole_number_between(1, 256));
  add_quiet_and_progress(command, options.common);
}

void add_start(CLI::App& sweep, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = sweep.add_subcommand(
      "start",
      "Measure all runs of a sweep file. The same command continues an interrupted sweep, and adds "
      "the new runs of a longer file. This is the default.");
  command->add_option("file", options->file, "Sweep file.")->required()->type_name("SWEEP.toml");
  add_execution_flags(*command, *options);
  command->add_flag("--prepare", options->prepare,
                    "Make the folder with the list of runs, and measure nothing.");
  command->callback([options, &exit_code] {
    const std::string text = sweep_text(options->file);
    const SweepFolder folder = SweepFolder::make(text, options->file, options->folder);
    if (options->prepare) {
      print_state(folder);
    } else {
      exit_code = measure_sweep(folder, *options);
    }
  });
}

void add_run(CLI::App& sweep, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = sweep.add_subcommand(
      "run",
      "Measure single runs of a sweep, one after the other. Runs with a result are skipped.");
  add_folder(*command, options->folder);
  command->add_option("id", options->ids, "Numbers of runs, such as 17 or 20-25.")
      ->required()
      ->type_name("ID");
  add_quiet_and_progress(*command, options->common);
  command->callback([options, &exit_code] { exit_code = measure_runs(*options); });
}

void add_status(CLI::App& sweep, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command =
      sweep.add_subcommand("status", "Print the numbers of runs by state, and all failures.");
  add_folder(*command, options->folder);
  command->callback([options, &exit_code] {
    print_state(SweepFolder(options->folder));
    exit_code = kOk;
  });
}

void add_collect(CLI::App& sweep, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = sweep.add_subcommand(
      "collect",
      "Write the results as one table with a row per point. The folder gets table.csv, table.jsonl "
      "and table.h5. The last two have the profiles too.");
  add_folder(*command, options->folder);
  command->callback([options, &exit_code] {
    const SweepFolder folder(options->folder);
    write_table(folder, read_table(folder));
    print_state(folder);
    exit_code = kOk;
  });
}

void add_plot(CLI::App& sweep, int& exit_code) {
  struct PlotOptions {
    std::string folder;
    std::string out;
    SweepPlot plot;
    bool log = false;
  };
  auto options = std::make_shared<PlotOptions>();
  CLI::App* command = sweep.add_subcommand(
      "plot",
      "Draw the results as points with error bars. Quantities are columns of the table. * and / "
      "join columns and numbers, as in 1/theory.psi.");
  add_folder(*command, options->folder);
  command->add_option("--x", options->plot.x, "Quantity of the x axis.")
      ->required()
      ->type_name("QUANTITY");
  command->add_option("--y", options->plot.y, "Quantity of the y axis.")
      ->required()
      ->type_name("QUANTITY");
  command
      ->add_option(
          "--by", options->plot.by,
          "Column whose values are the series. Default: all axes of the sweep that --x does "
          "not contain.")
      ->type_name("COLUMN");
  command->add_flag("--log", options->log, "Logarithmic axes.");
  command->add_flag("--log-x", options->plot.log_x, "Logarithmic x axis.");
  command->add_flag("--log-y", options->plot.log_y, "Logarithmic y axis.");
  command->add_flag("--theory", options->plot.theory, "Draw the lines of the theories.");
  command->add_option("--title", options->plot.title, "Title of the chart.")->type_name("TEXT");
  command->add_option("--x-label", options->plot.x_label, "Label of the x axis.")
      ->type_name("TEXT");
  command->add_option("--y-label", options->plot.y_label, "Label of the y axis.")
      ->type_name("TEXT");
  command->add_option("--out", options->out, "File of the chart.")
      ->required()
      ->check(named_file())
      ->type_name("FILE.png|svg");
  command->callback([options, &exit_code] {
    const std::filesystem::path out = options->out;
    if (out.extension() != ".png" && out.extension() != ".svg") {
      throw UserError({"--out", 0, 0}, "'" + options->out + "' is no picture",
                      "give a name such as chart.png or chart.svg");
    }
    require_writable_file(out, "--out");
    options->plot.log_x |= options->log;
    options->plot.log_y |= options->log;
    const SweepFolder folder(options->folder);
    const SweepTable table = read_table(folder);
    if (table.rows.empty()) {
      throw UserError({options->folder}, "the sweep has no results",
                      "measure it with `clatter sweep FILE --out DIR`");
    }
    const Chart chart = chart_of(table, folder.sweep().axes(), options->plot);
    if (!has_points(chart)) {
      throw UserError({options->folder}, "the chart has no points",
                      "give columns of numbers, which are positive on logarithmic axes");
    }
    write_chart(out, chart);
    exit_code = kOk;
  });
}

void add_submit(CLI::App& sweep, int& exit_code) {
  struct SubmitOptions {
    std::string folder;
    bool slurm = false;
    bool parallel = false;
    bool dry_run = false;
    int chunk = 0;
    TaskLimits limits;
  };
  auto options = std::make_shared<SubmitOptions>();
  CLI::App* command = sweep.add_subcommand(
      "submit",
      "Give the runs without result to a scheduler. `clatter sweep FILE --out DIR "
      "--prepare` makes the folder without running anything.");
  add_folder(*command, options->folder);
  CLI::Option* slurm = command->add_flag("--slurm", options->slurm,
                                         "Write the batch script DIR/slurm/job.sh and submit it.");
  command
      ->add_flag("--parallel", options->parallel,
                 "Print the command line for GNU parallel on stdout.")
      ->excludes(slurm);
  command
      ->add_option("--chunk", options->chunk,
                   "Runs per task. Default: 1, with Slurm at most 1000 tasks.")
      ->check(whole_number_between(1, 100'000));
  add_cluster_flags(*command, options->limits, options->dry_run, slurm);
  command->callback([options, &exit_code] {
    const SweepFolder folder(options->folder);
    exit_code = kOk;
    if (options->parallel) return print(parallel_line(folder, options->chunk));
    if (!options->slurm) {
      throw UserError({"submit", 0, 0}, "no scheduler is given", "add --slurm or --parallel");
    }
    const std::filesystem::path script =
        write_batch_script(folder, options->chunk, options->limits);
    if (script.empty()) return print_state(folder);
    if (options->dry_run) return print(script.string() + '\n');
    submit_batch(script);
  });
}

void add_study(CLI::App& sweep, int& exit_code, const char* name, const char* help,
               Study (*study_of)(int)) {
  struct StudyOptions {
    SweepOptions sweep;
    int dimension = 2;
  };
  auto options = std::make_shared<StudyOptions>();
  CLI::App* command = sweep.add_subcommand(name, help);
  add_execution_flags(*command, options->sweep);
  command->add_option("--dimension", options->dimension, "2: disks. 3: spheres.")
      ->check(whole_number_between(2, 3))
      ->capture_default_str();
  command->callback([options, study_of, name, &exit_code] {
    const Study study = study_of(options->dimension);
    const SweepFolder folder =
        SweepFolder::make(study.sweep, std::string(name) + ".toml", options->sweep.folder);
    exit_code = measure_sweep(folder, options->sweep);
    const SweepTable table = read_table(folder);
    if (exit_code == kInterrupted || table.rows.empty()) return;
    write_table(folder, table);
    write_study_charts(folder, table, study);
  });
}

}  // namespace

void add_sweep_command(CLI::App& program, int& exit_code) {
  CLI::App* sweep = program.add_subcommand(
      "sweep",
      "Measure a scene at many points of its parameters. A sweep file names the scene and the "
      "parameters: `clatter sweep FILE --out DIR` measures them.");
  sweep->require_subcommand(1);
  add_start(*sweep, exit_code);
  add_run(*sweep, exit_code);
  add_status(*sweep, exit_code);
  add_collect(*sweep, exit_code);
  add_plot(*sweep, exit_code);
  add_submit(*sweep, exit_code);
  add_study(*sweep, exit_code, "fig31",
            "Measure and draw the temperature of a vibrated gas against its dissipation, with the "
            "theories.",
            temperature_study);
  add_study(*sweep, exit_code, "rough",
            "Measure and draw the ratio of spin and translational temperature of rough particles, "
            "with the theory.",
            rough_study);
  add_study(*sweep, exit_code, "mixture",
            "Measure and draw the ratio of the temperatures of two species against their masses, "
            "with the theory.",
            mixture_study);
  add_study(*sweep, exit_code, "demon",
            "Measure and draw how unequal two compartments of a shaken gas become, against its "
            "restitution.",
            demon_study);
  add_study(*sweep, exit_code, "shear",
            "Measure and draw the temperature and the viscosity of a sheared gas against its "
            "restitution, with the theories.",
            shear_study);
}

}  // namespace clatter
