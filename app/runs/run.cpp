#include "app/runs/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/schedule.h"
#include "engine/system/signals.h"
#include "engine/system/write_file.h"

namespace clatter {

static std::uint64_t seed_of(const CommonOptions& options, const std::optional<Resumed>& resumed) {
  return options.seed.value_or(resumed ? resumed->checkpoint.seed : 1);
}

std::filesystem::path checkpoint_path(const CommonOptions& options,
                                      const CheckpointOptions& checkpoints,
                                      const std::optional<Resumed>& resumed,
                                      const std::string& out) {
  if (!checkpoints.file.empty()) return checkpoints.file;
  if (out.empty() || is_special(out)) {
    return fmt::format("{}-seed{}.checkpoint", std::filesystem::path(options.scene).stem().string(),
                       seed_of(options, resumed));
  }
  std::filesystem::path file = out;
  if (!file.has_filename()) file = file.parent_path();
  return file.replace_extension(".checkpoint");
}

void require_checkpoint_place(const std::filesystem::path& file,
                              const CheckpointOptions& checkpoints) {
  const bool requested = !checkpoints.file.empty();
  if (requested) require_writable_file(file, "--checkpoint");
  for (const std::filesystem::path& place : {file, previous_checkpoint(file)}) {
    std::error_code error;
    const bool exists = std::filesystem::exists(place, error);
    if (error == std::errc::filename_too_long) {
      throw UserError({"--checkpoint", 0, 0}, "the name " + place.string() + " is too long",
                      "name a checkpoint");
    }
    if (!exists || (std::filesystem::is_regular_file(place) && is_checkpoint(place))) continue;
    throw UserError({"--checkpoint", 0, 0}, place.string() + " exists and is not a checkpoint",
                    requested ? "give another name" : "move it, or name a checkpoint");
  }
}

template <int D>
Run<D>::Run(const std::string& command, const Scene& scene, const CommonOptions& options,
            const CheckpointOptions& checkpoints, std::optional<Resumed> resumed,
            const std::filesystem::path& file)
    : command_(command),
      scene_(scene),
      quiet_(options.quiet),
      options_(checkpoints),
      file_(file),
      resumed_(std::move(resumed)),
      seed_(seed_of(options, resumed_)) {
  if (!resumed_) {
    run_.emplace(scene, seed_, interrupted);
    return;
  }
  auto& saved = std::get<RunState<D>>(resumed_->checkpoint.saved);
  const std::string laws = changed_laws(*resumed_);
  if (!laws.empty()) saved.watchdog.reset();
  run_.emplace(scene, seed_, saved, interrupted);
  averages_go_on_ = !resumed_->checkpoint.measurement.empty() &&
                    averages_go_on(saved, !differs(*resumed_, "particles.inertia"),
                                   simulation().model(), scene.measure);
  saved = {};  // frees memory
  if (!laws.empty() && !quiet_) {
    std::fprintf(stderr, "clatter: laws changed at t = %g: %s\n", simulation().time(),
                 laws.c_str());
  }
}

template <int D>
Measurement<D>& Run<D>::measure(double end) {
  if (!averages_go_on_) {
    measurement_.emplace(simulation(), scene_.measure, end);
    told_start_ = measurement_->averages_start();
    if (resumed_) note_new_averages();
    return *measurement_;
  }
  require_same_measure(*resumed_, simulation().time() <= scene_.measure.burn_in);
  std::string& saved = resumed_->checkpoint.measurement;
  // The last run may have ended within the burn-in, and begun averages early.
  const bool restart = differs(*resumed_, kBurnInKey);
  measurement_.emplace(simulation(), scene_.measure, end, ArchiveReader(saved, resumed_->file),
                       restart ? Averages::Restart : Averages::GoOn);
  told_start_ = measurement_->averages_start();
  if (restart) note_new_averages();
  saved.clear();
  return *measurement_;
}

template <int D>
bool Run<D>::ever_spins() const {
  constexpr double kForever = std::numeric_limits<double>::infinity();
  Schedule schedule(scene_);
  bool spins = run_->simulation().model().spins || schedule.laws().spins();
  for (; schedule.next() < kForever; schedule.advance()) spins |= schedule.laws().spins();
  return spins || schedule.laws().spins();
}

template <int D>
void Run<D>::record(const std::filesystem::path& file, double every) {
  std::string saved = resumed_ ? std::move(resumed_->checkpoint.trajectory) : "";
  const std::vector<std::string> names = names_of(scene_.species);
  if (saved.empty()) {
    std::error_code ignored;
    const std::filesystem::path frames = frames_path(file, trajectory_format(file, "--trajectory"));
    if (resumed_ &&
        (std::filesystem::exists(file, ignored) || std::filesystem::exists(frames, ignored))) {
      throw UserError({"--trajectory", 0, 0},
                      file.string() + " exists, and the checkpoint has no trajectory",
                      "give another name, because this run would not continue the file");
    }
    recorder_.emplace(file, every, ever_spins(), names, simulation());
  } else {
    recorder_.emplace(file, every, ever_spins(), names, simulation(), saved, resumed_->file);
  }
}

template <int D>
void Run<D>::log_events(const std::filesystem::path& file, const EventSelection& selection) {
  const std::string saved = resumed_ ? std::move(resumed_->checkpoint.events) : "";
  const std::vector<std::string> names = names_of(scene_.species);
  if (!saved.empty()) {
    events_.emplace(file, selection, ever_spins(), names, simulation(), saved, resumed_->file);
    return;
  }
  std::error_code ignored;
  for (const std::filesystem::path& existing : {file, records_path(file)}) {
    if (!resumed_ || !std::filesystem::exists(existing, ignored)) continue;
    throw UserError({"--events", 0, 0},
                    existing.string() + " exists, and the checkpoint has no event log",
                    "give another name, because this run would not continue the file");
  }
  events_.emplace(file, selection, ever_spins(), names, simulation());
}

template <int D>
void Run<D>::note_left_files() const {
  if (quiet_ || !resumed_) return;
  if (!recorder_ && !resumed_->checkpoint.trajectory.empty()) {
    std::fprintf(stderr,
                 "note: the trajectory of %s does not continue without --trajectory and --every\n",
                 resumed_->file.c_str());
  }
  if (!events_ && !resumed_->checkpoint.events.empty()) {
    std::fprintf(stderr, "note: the event log of %s does not continue without --events\n",
                 resumed_->file.c_str());
  }
}

template <int D>
void Run<D>::note_new_averages() const {
  if (quiet_) return;
  std::fprintf(stderr, "clatter: averages restart at t = %g\n", told_start_);
}

template <int D>
bool Run<D>::until(double time, Progress& progress) {
  while (recorder_ && recorder_->next_time() <= time) {
    if (!advance(recorder_->next_time(), progress)) return false;
    recorder_->add(simulation());
  }
  return advance(time, progress);
}

template <int D>
bool Run<D>::advance(double time, Progress& progress) {
  constexpr std::chrono::milliseconds kSlice{100};
  ended_early_ = true;
  try {
    for (bool arrived = false; !arrived; progress.update(simulation().time())) {
      if (interrupted()) return false;
      const auto due = Clock::now() + kSlice;
      arrived = run_->run_until(time, kNoLimit, kNoLimit,
                                [due] { return interrupted() || Clock::now() >= due; });
      if (events_) events_->flush();
      if (measurement_ && measurement_->averages_start() != told_start_) {
        told_start_ = measurement_->averages_start();
        note_new_averages();
      }
      const std::chrono::duration<double> since_written = Clock::now() - last_written_;
      if (!options_.file.empty() && since_written.count() >= options_.every) write();
    }
  } catch (const PhysicalStop& stop) {
    stop_ = stop;
    return false;
  }
  // An interrupt after the end has no effect on the run: it is complete.
  ended_early_ = false;
  return true;
}

template <int D>
Checkpoint Run<D>::checkpoint() {
  return {.program = "clatter " CLATTER_VERSION,
          .command = command_,
          .scene = scene_to_toml(scene_),
          .start_temperature = scene_.particles.start.temperature,
          .seed = seed_,
          .saved = simulation().save(),
          .measurement = measurement_ ? measurement_->save() : "",
          .film = film_state ? film_state() : "",
          .trajectory = recorder_ ? recorder_->save() : "",
          .events = events_ ? events_->save() : ""};
}

template <int D>
void Run<D>::mark() {
  marked_ = checkpoint();
}

// A failed checkpoint does not end a run. The next may succeed.
template <int D>
void Run<D>::write() {
  try {
    if (marked_) {
      write_checkpoint(file_, *marked_);
    } else {
      Checkpoint now = checkpoint();
      write_checkpoint(file_, now);
    }
    failure_.clear();
  } catch (const RunError& error) {
    failure_ = error.what();
  }
  last_written_ = Clock::now();
}

template <int D>
std::string Run<D>::how_to_resume() const {
  return "continue with --resume " + file_.string() + (recorder_ ? ' ' + recorder_->flags() : "") +
         (events_ ? ' ' + events_->flags() : "");
}

template <int D>
std::string Run<D>::rescue() {
  write();
  return failure_.empty() ? "; " + how_to_resume() : "; no checkpoint was written: " + failure_;
}

template <int D>
void Run<D>::put_aside() {
  if (!ended_early_ && (options_.file.empty() || !options_.of_end)) return;
  if (ended_early_ && !quiet_) std::fputs("clatter: writing the checkpoint\n", stderr);
  write();
  if (ended_early_ && !stop_ && failure_.empty() && !quiet_) {
    std::fprintf(stderr, "clatter: interrupted at t = %g; %s\n", simulation().time(),
                 how_to_resume().c_str());
  }
}

void require_no_overlap(const RunChecks& checks) {
  constexpr double kRounding = 1e-9;  // diameters
  if (checks.deepest_overlap <= kRounding) return;
  throw PhysicalStop(fmt::format(
      "particles overlapped by {:.3g} diameters: events were lost; please report this scene "
      "and seed",
      checks.deepest_overlap));
}

// Completes the trajectory and the event log. Those of an interrupted run are completed by its
// continuation. Returns the failure, if any.
template <int D>
std::string Run<D>::finish_files() {
  if (ended_early_ && !stop_) return "";
  std::string failures;
  // A failure of one file leaves the other one to finish.
  const auto finish = [&failures](const auto& finish_file) {
    try {
      finish_file();
    } catch (const RunError& error) {
      failures += (failures.empty() ? "" : "; ") + std::string(error.what());
    }
  };
  if (recorder_) finish([&] { recorder_->finish(); });
  if (events_) finish([&] { events_->finish(stop_ || !options_.file.empty()); });
  return failures;
}

template <int D>
int Run<D>::end() {
  const std::string unfinished = finish_files();
  if (stop_) {
    const std::string remedy = stop_->remedy().empty() ? "" : " --set " + stop_->remedy();
    throw PhysicalStop(stop_->what() +
                       (failure_.empty() ? "; " + how_to_resume() + remedy
                                         : "; no checkpoint was written: " + failure_) +
                       (unfinished.empty() ? "" : "; " + unfinished));
  }
  require_no_overlap(simulation().checks());
  // An interrupted run throws too: its exit code would claim that the state has been saved.
  if (!failure_.empty()) throw RunError("no checkpoint was written: " + failure_);
  if (!unfinished.empty()) throw RunError(unfinished + rescue());
  return ended_early_ ? kInterrupted : kOk;
}

template class Run<2>;
template class Run<3>;

}  // namespace clatter
