#include "app/bench/accuracy.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <string_view>

#include "app/bench/accuracy_output.h"
#include "app/bench/pictures.h"
#include "app/bench/tables.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "engine/system/write_file.h"
#include "render/output/movie.h"

namespace clatter {

namespace {

using Replicas = std::vector<RunResult>;

RunResult observe_one(const Setting& setting, double duration, std::uint64_t seed) {
  const Effort effort{.burn_in = 0.2 * duration, .duration = setting.duration * duration};
  return setting.time_step > 0.0 ? observe_stepped(setting.scene, setting.time_step, effort, seed)
                                 : observe(setting.scene, effort, seed);
}

// Runs all settings in turn, repeatedly, so that the load of the machine affects them equally.
std::vector<Replicas> observe_all(const ParameterSweep& dial, double duration) {
  std::vector<Replicas> runs(dial.settings.size());
  for (std::uint64_t seed = 1; seed <= kAccuracyReplicas; ++seed) {
    for (std::size_t k = 0; k < runs.size(); ++k) {
      runs[k].push_back(observe_one(dial.settings[k], duration, seed));
    }
  }
  return runs;
}

AccuracyRow row_of(const Setting& setting, const Replicas& replicas, const Replicas& reference) {
  AccuracyRow row{.setting = setting.name,
                  .value = setting.value,
                  .cpu_per_time = std::numeric_limits<double>::infinity(),
                  .elasticised_share = replicas.front().elasticised_share,
                  .comparison = compare(replicas, reference)};
  double events = 0.0, seconds = 0.0;
  for (const RunResult& replica : replicas) {
    row.cpu_per_time = std::min(row.cpu_per_time, replica.cpu_seconds / replica.time);
    row.deepest_overlap = std::max(row.deepest_overlap, replica.deepest_overlap);
    row.bytes = std::max(row.bytes, replica.bytes);
    events += replica.events;
    seconds += replica.cpu_seconds;
  }
  row.events_per_second = events / seconds;
  return row;
}

// The extrapolation of all settings but the first to value 0, compared with the first.
AccuracyRow limit_row(const ParameterSweep& dial, const std::vector<Replicas>& runs) {
  std::vector<double> values;
  for (std::size_t s = 1; s < runs.size(); ++s) values.push_back(dial.settings[s].value);
  return {.setting = "-> 0",
          .value = 0.0,
          .cpu_per_time = kNotANumber,
          .events_per_second = kNotANumber,
          .bytes = kNotANumber,
          .deepest_overlap = kNotANumber,
          .elasticised_share = kNotANumber,
          .comparison = compare_limit(values, std::span(runs).subspan(1), runs.front())};
}

// The margin of one tenth is about the precision of both values.
void mark_dominated(std::vector<AccuracyRow>& rows) {
  constexpr double kLess = 0.9;
  for (AccuracyRow& row : rows) {
    row.dominated = std::ranges::any_of(rows, [&](const AccuracyRow& other) {
      return other.cpu_per_time < kLess * row.cpu_per_time &&
             other.comparison.error < kLess * row.comparison.error;
    });
  }
}

AccuracyTable run_dial(const ParameterSweep& dial, double duration) {
  const std::vector<Replicas> runs = observe_all(dial, duration);
  AccuracyTable table{dial.name, dial.title, {}};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    table.rows.push_back(row_of(dial.settings[k], runs[k], runs.front()));
  }
  mark_dominated(table.rows);
  if (dial.has_limit) table.rows.push_back(limit_row(dial, runs));
  return table;
}

bool asked_for(const std::string& dial, const AccuracyBench& bench) {
  return bench.dials.empty() || std::ranges::find(bench.dials, dial) != bench.dials.end();
}

// Throws if the scene has no sweep of a requested name.
void require_known(const std::vector<ParameterSweep>& dials, const AccuracyBench& bench) {
  std::vector<std::string> known(std::begin(kPictureDials), std::end(kPictureDials));
  for (const ParameterSweep& dial : dials) known.push_back(dial.name);
  for (const std::string& name : bench.dials) {
    if (std::ranges::find(known, name) != known.end()) continue;
    std::string names;
    for (const std::string& word : known) names += (names.empty() ? "" : ", ") + word;
    throw UserError({"--dial", 0, 0}, "this scene has no dial '" + name + "'",
                    "choose one of " + names);
  }
}

void require_places(const AccuracyBench& bench) {
  const std::vector<Output> outputs = {{"--csv", bench.csv},
                                       {"--json", bench.json},
                                       {"--plot", bench.plot},
                                       {"--markdown", bench.markdown}};
  require_distinct(outputs);
  for (const Output& output : outputs) {
    if (!output.path.empty()) require_writable_file(output.path, output.flag);
  }
}

}  // namespace

int bench_accuracy(const AccuracyBench& bench) {
  require_places(bench);
  Scene scene = load_scene(bench.scene, {});
  if (scene.particles.count < 2 || !scene.changes.empty()) {
    throw UserError({bench.scene, 0, 0}, "the bench needs constant laws and at least two disks",
                    "choose another scene, or remove [[change]]");
  }
  require_known(sweeps_of(scene, 1.0), bench);
  const Effort effort{.burn_in = 0.2 * bench.duration, .duration = bench.duration};
  const double rate = observe(scene, effort, 1).collision_rate;

  std::fputs(accuracy_statement(bench).c_str(), stderr);
  std::vector<AccuracyTable> tables;
  for (const ParameterSweep& dial : sweeps_of(scene, 1.0 / rate)) {
    if (!asked_for(dial.name, bench)) continue;
    tables.push_back(run_dial(dial, bench.duration));
    print(accuracy_text(tables.back()));
  }
  std::vector<PictureTable> pictures;
  for (const char* dial : kPictureDials) {
    if (!asked_for(dial, bench)) continue;
    if (std::string_view(dial) == "encoding" && !has_film_encoder()) {
      std::fputs("no encodings: they need ffmpeg (apt install ffmpeg)\n", stderr);
      continue;
    }
    pictures.push_back(measure_pictures(dial, scene, effort.burn_in));
    print(accuracy_text(pictures.back()));
  }
  if (!bench.csv.empty()) write_file(bench.csv, accuracy_csv(tables, pictures));
  if (!bench.json.empty()) write_file(bench.json, accuracy_json(bench, tables, pictures));
  if (!bench.plot.empty()) write_plot(bench.plot, accuracy_plot(bench, tables));
  if (!bench.markdown.empty()) {
    write_file(bench.markdown, with_accuracy_tables(bench, tables, pictures));
  }
  return kOk;
}

}  // namespace clatter
