#include "app/measure/measure_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/measure/ensemble.h"
#include "app/measure/feature_cost.h"
#include "app/results/csv_tables.h"
#include "app/results/hdf5_file.h"
#include "app/results/result_json.h"
#include "app/results/theory_json.h"
#include "app/results/trajectory.h"
#include "app/results/vtk_files.h"
#include "app/runs/run.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/scene/act_checks.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/state_file.h"
#include "engine/system/allocation.h"
#include "engine/system/signals.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"
#include "engine/text.h"

namespace clatter {

namespace {

// Maximum length of a series: some GB of result file.
constexpr double kMaxSamples = 1e7;

// A large share of elastic collisions shows a wrong t_c. A t_c near the time between collisions
// suppresses dissipation. A very short t_c lets grains at rest bounce for ever, which takes most of
// the CPU time.
void advise_on_contact_time(const Scene& scene, const Measured& measured) {
  constexpr double kMaxElastic = 0.9;
  constexpr double kLong = 0.1;    // in units of the time between collisions
  constexpr double kShort = 1e-3;  // in the same unit
  const auto elastic = static_cast<double>(measured.elasticised + measured.elasticised_wall);
  const auto all = static_cast<double>(measured.pair_collisions + measured.wall_collisions);
  if (!scene.contact_time || elastic <= kMaxElastic * all) return;
  std::fprintf(stderr, "note: collapse.contact_time made %.0f %% of all collisions elastic, ",
               100.0 * elastic / all);
  const double rate = collision_rate(scene, measured.temperature.mean);
  if (*scene.contact_time * rate > kLong) {
    std::fprintf(
        stderr,
        "because it is near the time between collisions; a smaller value, for example %.1g, "
        "restores the dissipation\n",
        kShort / rate);
  } else {
    std::fprintf(stderr,
                 "because grains rest on each other; a larger value, for example %s, makes the run "
                 "faster\n",
                 number_text(10.0 * *scene.contact_time).c_str());
  }
}

// Throws if a table or map of an earlier run cannot be replaced.
void require_replaceable(const std::filesystem::path& file, const char* flag) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw UserError({flag, 0, 0}, file.string() + " is a folder",
                    "remove it, or give another name");
  }
  if (std::filesystem::exists(file, ignored)) require_writable(file);
}

// Throws if the selection of events names no particle or region of the scene.
void require_selectable(const EventSelection& selection, const Scene& scene) {
  for (const std::uint32_t particle : selection.particles) {
    if (particle < final_count(scene)) continue;
    throw UserError({"--events-of", 0, 0}, "there is no particle " + std::to_string(particle),
                    particle_numbers(static_cast<int>(final_count(scene))));
  }
  if (selection.region.empty()) return;
  const auto sides = static_cast<std::size_t>(2 * scene.dimension());
  if (selection.region.size() != sides) {
    throw UserError({"--events-in", 0, 0},
                    std::to_string(selection.region.size()) + " numbers are given",
                    "give " + std::to_string(sides) + ": the lower and upper limit of each axis");
  }
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    const auto index = static_cast<std::size_t>(2 * axis);
    const double low = selection.region[index], high = selection.region[index + 1];
    if (low < high && low < scene.box[axis] && high > 0.0) continue;
    throw UserError({"--events-in", 0, 0},
                    fmt::format("no place of the box is between {} and {} along {}", low, high,
                                kAxes[static_cast<std::size_t>(axis)].name),
                    "give the lower and upper limit of each axis, within the box");
  }
}

// Throws before a long run if its results cannot be written.
void prepare_outputs(const MeasureOptions& options, const Scene& scene,
                     const std::filesystem::path& checkpoint) {
  const Measure& spec = scene.measure;
  std::vector<Output> outputs = {{"--checkpoint", checkpoint},
                                 {"--checkpoint", previous_checkpoint(checkpoint)},
                                 {"--out", options.out},
                                 {"--csv", options.csv},
                                 {"--vtk", options.vtk},
                                 {"--hdf5", options.hdf5},
                                 {"--trajectory", options.trajectory},
                                 {"--events", options.events},
                                 {"--save-state", options.save_state}};
  if (!options.events.empty() && records_path(options.events) != options.events) {
    outputs.push_back({"--events", records_path(options.events)});
  } else if (!options.events.empty() && !scene.species.empty()) {
    outputs.push_back({"--events", particles_path(options.events)});
  }
  if (!options.trajectory.empty()) {
    const TrajectoryFormat format = trajectory_format(options.trajectory, "--trajectory");
    const std::filesystem::path frames = frames_path(options.trajectory, format);
    if (frames != options.trajectory) outputs.push_back({"--trajectory", frames});
  }
  std::vector<Output> tables;
  const auto add_tables = [&](const char* flag, const std::filesystem::path& folder,
                              const auto& names) {
    if (folder.empty()) return;
    for (const auto& name : names) tables.push_back({flag, folder / name});
  };
  add_tables("--csv", options.csv, table_files());
  add_tables("--vtk", options.vtk, vtk_names());
  outputs.insert(outputs.end(), tables.begin(), tables.end());
  require_distinct(outputs, inputs_of(options.common, options.checkpoints, scene, checkpoint));
  require_checkpoint_place(checkpoint, options.checkpoints);
  if (!options.vtk.empty() && spec.fields.empty()) {
    throw UserError({"--vtk", 0, 0}, "the scene measures no fields",
                    "add --set 'measure.fields=[\"density\", \"velocity\", \"temperature\"]'");
  }
  if (!(options.csv.empty() && options.hdf5.empty()) && spec.fields.empty() &&
      spec.observables.empty() && !options.common.quiet) {
    std::fputs("note: measure.fields is empty: no profile and no maps\n", stderr);
  }
  if (!options.out.empty()) require_writable_file(options.out, "--out");
  if (!options.hdf5.empty()) require_writable_file(options.hdf5, "--hdf5");
  if (!options.save_state.empty()) {
    if (scene.shear_rate) {
      throw UserError({"--save-state", 0, 0},
                      "a start state has no images that have slid, as those of a sheared box have",
                      "remove --save-state; --checkpoint continues the run");
    }
    require_writable_file(options.save_state, "--save-state");
  }
  if (!options.trajectory.empty()) {
    trajectory_format(options.trajectory, "--trajectory");
    if (final_count(scene) != scene.particles.count) {
      throw UserError({"--trajectory", 0, 0},
                      "all frames of a trajectory have the same particles, and a puff adds some",
                      "remove --trajectory, or the [[change]] with the puff");
    }
    require_writable_file(options.trajectory, "--trajectory");
  }
  if (!options.events.empty()) {
    event_log_format(options.events, "--events");
    require_writable_file(options.events, "--events");
    require_selectable(options.selection, scene);
  }
  for (const Output& table : tables) require_replaceable(table.path, table.flag);
  if (!options.csv.empty()) make_folder(options.csv, "--csv");
  if (!options.vtk.empty()) make_folder(options.vtk, "--vtk");
}

// The main result, for a run whose results go to a file.
void note_temperature(const Measured& measured) {
  if (!(measured.duration > 0.0)) return;
  const double mean = measured.temperature.mean, error = measured.temperature.standard_error;
  // As many digits as the error has, with two of its own.
  const double digits =
      error > 0.0 ? std::floor(std::log10(mean)) - std::floor(std::log10(error)) : 4.0;
  std::fprintf(stderr, "note: temperature = %.*g +- %.2g, averaged over %g time units\n",
               static_cast<int>(std::clamp(digits, 0.0, 13.0)) + 2, mean, error, measured.duration);
}

template <int D>
nlohmann::ordered_json json_of(const MeasureOptions& options, const Scene& scene, Run<D>& run,
                               const Measured& measured, const Performance& performance) {
  auto json = result_json(scene, run.seed(), run.simulation(), measured, performance);
  const AccuracyGoal& goal = options.accuracy;
  if (goal.asked_for() && measured.duration > 0.0) {
    json["accuracy"] = {{"of", goal.of},
                        {"asked", goal.relative},
                        {"reached", relative_error(estimate_for(goal, measured))}};
  }
  return json;
}

void write_json(const std::string& out, const nlohmann::ordered_json& result) {
  const std::string text = json_text(result) + "\n";
  if (out.empty()) {
    print(text);
  } else {
    write_file(out, text);
  }
}

// The fixtures of a gas, or the lower and the upper face of its piston where it is now.
template <int D>
std::vector<Fixture<D>> shapes_in(Run<D>& run) {
  const Simulation<D>& simulation = run.simulation();
  const PistonFlight* flight = simulation.free_piston();
  if (!flight) return simulation.model().fixtures;
  Scene faces = run.scheduled().laws();
  const Piston piston = *faces.piston;
  const double middle = flight->at(simulation.base_time());
  for (const double half : {-0.5 * piston.thickness, 0.5 * piston.thickness}) {
    Partition& face = faces.partitions.emplace_back();
    face.axis = piston.axis;
    face.position = middle + half;
  }
  return fixtures_of<D>(faces);
}

// Writes each output even if another fails. Then throws the first error, with a checkpoint from
// which the results can be written again.
template <int D>
void write_results(const MeasureOptions& options, const nlohmann::ordered_json& result,
                   const Measured& measured, Run<D>& run, const StopRequest& stop) {
  std::string failure;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const std::exception& error) {
      if (failure.empty()) failure = error.what();
    }
  };
  attempt([&] { write_json(options.out, result); });
  if (!options.csv.empty()) attempt([&] { write_tables(options.csv, measured, stop); });
  if (!options.vtk.empty()) {
    attempt([&] {
      const std::string origin = result.at("program").get<std::string>() + ", seed " +
                                 result.at("seed").dump() + ", state hash " +
                                 result.at("state_hash").get<std::string>();
      write_vtk(options.vtk, measured, origin, stop);
      write_vtk_fixtures(options.vtk, shapes_in(run), origin);
    });
  }
  if (!options.hdf5.empty()) attempt([&] { write_hdf5(options.hdf5, result, measured, stop); });
  if (!options.save_state.empty()) {
    attempt([&] {
      write_file(options.save_state,
                 state_to_csv(run.simulation().state(), run.scheduled().laws().species));
    });
  }
  if (!failure.empty()) throw RunError(failure + run.rescue());
}

// Replicas have no checkpoint. A result that cannot be written goes to stdout; if stdout fails, it
// goes to the new file `spare`.
void write_or_rescue(const std::string& out, const std::string& spare,
                     const nlohmann::ordered_json& result) {
  std::string failure;
  try {
    return write_json(out, result);
  } catch (const RunError& error) {
    failure = error.what();
  }
  std::error_code ignored;
  const std::string other = out.empty() ? spare : "";
  if (std::filesystem::exists(other, ignored)) {
    throw RunError(failure + "; the result is lost, because " + other + " exists");
  }
  try {
    write_json(other, result);
  } catch (const RunError& error) {
    throw RunError(failure + "; the result is lost: " + error.what());
  }
  throw RunError(failure + "; the result is " + (other.empty() ? "on stdout" : "in " + other));
}

// Replicas differ in the seed only, so that the outputs of a single run are not available.
int measure_replicas(const MeasureOptions& options, const Scene& scene, double end) {
  if (!scene.changes.empty()) {
    throw UserError({"--replicas", 0, 0}, "the laws of this scene change",
                    "measure each seed separately, or remove [[change]]");
  }
  const std::uint64_t seed = options.common.seed.value_or(1);
  constexpr std::uint64_t kLastSeed = std::numeric_limits<std::uint64_t>::max();
  if (seed > kLastSeed - static_cast<std::uint64_t>(options.replicas - 1)) {
    throw UserError({"--seed", 0, 0},
                    "the seeds of the replicas would exceed " + std::to_string(kLastSeed),
                    "give a smaller seed");
  }
  catch_interrupts();
  if (!options.out.empty()) require_writable_file(options.out, "--out");
  const Ensemble ensemble{options.replicas, seed, end, options.threads};
  Progress progress(options.common.shown_progress(), "measuring", 0.0, options.replicas * end);
  const EnsembleResult result = measure_ensemble(scene, ensemble, progress);
  const std::size_t complete = result.json.at("results").size();
  if (complete > 0 || !result.failure) {
    const std::filesystem::path scene_file = options.common.scene;
    write_or_rescue(options.out,
                    scene_file.stem().string() + "-seed" + std::to_string(seed) + ".json",
                    result.json);
  }
  if (result.failure) std::rethrow_exception(result.failure);
  return complete == static_cast<std::size_t>(options.replicas) ? kOk : kInterrupted;
}

// Whether a resumed run can continue to `end`. After a kill between the last checkpoint and the
// results, `end` is the time of the checkpoint, and only the results are missing.
bool goes_on_to(double end, const Resumed& resumed) {
  if (end != resumed.time()) return end > resumed.time();
  return !resumed.checkpoint.measurement.empty() && changed_laws(resumed).empty();
}

// Shortens the burn-in of a run that would end within it, or so soon after it that the windows of
// averages would be as short as the rounding of times. The burn-in keeps its share of the whole
// time. Exception: flags give both times.
void fit_burn_in(Measure& measure, double end, const CommonOptions& options) {
  constexpr double kShortest = 1e-12;  // share of the whole time
  const auto leaves_time = [&](double burn_in) { return end - burn_in > kShortest * end; };
  if (leaves_time(measure.burn_in)) return;
  const double shorter = end * (measure.burn_in / (measure.burn_in + measure.duration));
  if (options.sets("measure.burn_in") || !leaves_time(shorter)) {
    throw UserError({"--until", 0, 0}, "the run ends within the burn-in",
                    "give a time after measure.burn_in = " + number_text(measure.burn_in));
  }
  if (!options.quiet) {
    std::fprintf(
        stderr,
        "note: the run ends within measure.burn_in = %s; averages begin at t = %s instead\n",
        number_text(measure.burn_in).c_str(), number_text(shorter).c_str());
  }
  measure.burn_in = shorter;
}

template <int D>
int measure_one(const MeasureOptions& options, const Scene& scene, std::optional<Resumed> resumed,
                const std::filesystem::path& checkpoint, double end) {
  const double cpu_before = cpu_seconds();
  const auto began = std::chrono::steady_clock::now();
  Run<D> run("measure", scene, options.common, options.checkpoints, std::move(resumed), checkpoint);
  run.scheduled().use_threads(options.threads.value_or(processors()));
  Measurement<D>& measurement = run.measure(end);
  const std::uint64_t collisions_before = run.simulation().counts().pair_collisions;
  if (options.accuracy.asked_for()) estimate_for(options.accuracy, measurement.means());
  if (!options.trajectory.empty()) run.record(options.trajectory, options.every);
  if (!options.events.empty()) run.log_events(options.events, options.selection);
  run.note_left_files();
  try {
    Progress progress(options.common.shown_progress(), "measuring", run.simulation().time(), end);
    if (options.accuracy.asked_for()) {
      run_to_goal(options.accuracy, run, measurement, end, progress);
    } else {
      run.until(end, progress);
    }
  } catch (const RunError& error) {
    throw RunError(error.what() + run.rescue());
  }
  run.put_aside();
  // The results of an interrupted run are written in full.
  const StopRequest stop = run.ended_early() ? StopRequest() : StopRequest(interrupted);
  Measured measured;
  try {
    measured = measurement.result(stop);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
    const Performance performance{cpu_seconds() - cpu_before, elapsed.count(),
                                  run.simulation().counts().pair_collisions - collisions_before,
                                  peak_memory_bytes(), run.simulation().tiles()};
    write_results(options, json_of(options, scene, run, measured, performance), measured, run,
                  stop);
  } catch (const Interrupted&) {
    std::fprintf(stderr, "clatter: interrupted while the results were written%s\n",
                 run.rescue().c_str());
    return kInterrupted;
  }
  if (!options.common.quiet) {
    advise_on_contact_time(scene, measured);
    if (options.accuracy.asked_for()) {
      note_accuracy(options.accuracy, measured);
    } else if (!options.out.empty()) {
      note_temperature(measured);
    }
    warn_of_drift(options.accuracy, measured);
  }
  const int code = run.end();
  if (measured.residuals) require_closed(*measured.residuals);
  return code;
}

}  // namespace

void require_bounded_samples(const Measure& spec, double begin, double end) {
  const double span = end - begin, averaged = end - std::max(begin, spec.burn_in);
  if (span / spec.series_interval > kMaxSamples) {
    throw UserError({"measure.series_interval", 0, 0},
                    "the series would have " +
                        number_text(std::floor(span / spec.series_interval)) + " samples",
                    "choose at least " + number_text(span / kMaxSamples));
  }
  const auto require = [&](const std::string& key, double interval) {
    if (averaged / interval <= kMaxSamples) return;
    throw UserError({key, 0, 0}, "there would be more than 1e7 samples",
                    "choose at least " + number_text(averaged / kMaxSamples));
  };
  if (spec.estimator == Estimator::Snapshot) require("measure.interval", spec.interval);
  for (const auto& [name, kind] : kObservables) {
    const std::optional<double> interval = spec.sampling_interval(kind);
    if (!spec.observes(kind) || !interval) continue;
    require(fmt::format("measure.{}.interval", name), *interval);
  }
}

int measure(const MeasureOptions& options) {
  Scene scene = load(options.common, options.checkpoints.start_file());
  const double end = options.common.until.value_or(scene.measure.burn_in + scene.measure.duration);
  const double burn_in = scene.measure.burn_in;
  fit_burn_in(scene.measure, end, options.common);
  std::optional<Resumed> resumed = resume(options.common, options.checkpoints, scene);
  if (resumed && !goes_on_to(end, *resumed)) {
    throw UserError({"--until", 0, 0},
                    "the checkpoint is at t = " + number_text(resumed->time()) +
                        ", and the run ends at " + number_text(end),
                    "give a time after the checkpoint");
  }
  if (resumed && differs(*resumed, kBurnInKey)) {
    double& fitted = scene.measure.burn_in;
    fitted = std::max(fitted, std::min(burn_in, resumed->time()));
  }
  require_bounded_samples(scene.measure, 0.0, end);
  require_room(scene);
  if (!options.trajectory.empty() && end / options.every > kMaxSamples) {
    throw UserError({"--every", 0, 0}, "the trajectory would have more than 1e7 frames",
                    "choose at least " + number_text(end / kMaxSamples));
  }
  if (options.replicas > 1) return measure_replicas(options, scene, end);
  const std::filesystem::path checkpoint =
      checkpoint_path(options.common, options.checkpoints, resumed, options.out);
  catch_interrupts();  // a signal would leave the temporary files of outputs behind
  prepare_outputs(options, scene, checkpoint);
  return with_dimension(scene.dimension(), [&](auto dimension) {
    return measure_one<dimension>(options, scene, std::move(resumed), checkpoint, end);
  });
}

}  // namespace clatter
