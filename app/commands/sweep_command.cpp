#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/commands/flags.h"
#include "app/sweep/executor.h"
#include "app/sweep/run_one.h"
#include "app/sweep/sweep_table.h"
#include "app/system/exit_code.h"
#include "engine/error.h"
#include "engine/system/read_file.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

constexpr std::size_t kLargestSweep = 1'000'000;

struct SweepOptions {
  CommonOptions common;  // --quiet and --progress only
  std::string file;
  std::string folder;
  std::optional<int> threads;
  std::vector<std::string> ids;

  int processes() const {
    return threads.value_or(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  }
};

// The numbers in words such as 17 and 20-25.
std::vector<int> ids_of(const std::vector<std::string>& words) {
  std::vector<int> ids;
  for (const std::string& word : words) {
    const std::size_t dash = std::min(word.find('-'), word.size());
    const auto first = whole_number<int>(word.substr(0, dash));
    const auto last = dash == word.size() ? first : whole_number<int>(word.substr(dash + 1));
    if (!first || !last || *first < 1 || *last < *first) {
      throw UserError({"ID", 0, 0}, "'" + word + "' is no run", "give numbers such as 17 or 20-25");
    }
    for (int id = *first; id <= *last; ++id) ids.push_back(id);
  }
  return ids;
}

// Measures all runs, even after a failure. The exit code is that of the last failure.
int measure_runs(const SweepOptions& options) {
  SweepFolder folder(options.folder);
  int code = kOk;
  for (const int id : ids_of(options.ids)) {
    const int ended = measure_run(folder, id, options.common.shown_progress());
    if (ended == kInterrupted) return kInterrupted;
    if (ended != kOk) code = ended;
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

void add_start(CLI::App& sweep, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = sweep.add_subcommand(
      "start",
      "Measure all runs of a sweep file. The same command continues an interrupted sweep, and adds "
      "the new runs of a longer file. This is the default.");
  command->add_option("file", options->file, "Sweep file.")->required()->type_name("SWEEP.toml");
  command->add_option("--out", options->folder, "Folder of the sweep.")
      ->required()
      ->check(named_file())
      ->type_name("DIR");
  command
      ->add_option("--threads", options->threads,
                   "Number of runs at once. Default: the number of processors.")
      ->check(whole_number_between(1, 256));
  add_quiet_and_progress(*command, options->common);
  command->callback([options, &exit_code] {
    const std::string text =
        read_file(options->file, kLargestSweep, "a sweep is a text of a few kB");
    const SweepFolder folder = SweepFolder::make(text, options->file, options->folder);
    exit_code = execute_sweep(folder, options->processes(), options->common.shown_progress());
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
  CLI::App* command = sweep.add_subcommand("collect",
                                           "Write the results as one table, with a row per point: "
                                           "table.csv, table.jsonl and table.h5 in "
                                           "the folder. The last two have the profiles too.");
  add_folder(*command, options->folder);
  command->callback([options, &exit_code] {
    const SweepFolder folder(options->folder);
    write_table(folder, read_table(folder));
    print_state(folder);
    exit_code = kOk;
  });
}

}  // namespace

void add_sweep_command(CLI::App& program, int& exit_code) {
  CLI::App* sweep = program.add_subcommand(
      "sweep",
      "Measure a scene at many points of its parameters. A sweep file names the scene and the "
      "parameters.");
  sweep->require_subcommand(1);
  add_start(*sweep, exit_code);
  add_run(*sweep, exit_code);
  add_status(*sweep, exit_code);
  add_collect(*sweep, exit_code);
}

}  // namespace clatter
