#include "app/run.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/interrupt.h"
#include "app/write_file.h"
#include "engine/dynamics/start.h"
#include "engine/scene/scene_file.h"

namespace clatter {

std::unique_ptr<Simulation<2>> simulation_of(const Scene& scene, std::uint64_t seed) {
  return std::make_unique<Simulation<2>>(model_of(scene, seed), start_state(scene, seed));
}

// Where a checkpoint goes that nobody asked for: beside what the command writes, where that is a
// file or folder.
static std::filesystem::path checkpoint_beside(const std::string& out, const std::string& scene) {
  std::filesystem::path file = std::filesystem::path(scene).stem();
  if (!out.empty() && !is_special(out)) {
    file = out;
    if (!file.has_filename()) file = file.parent_path();
  }
  return file.replace_extension(".checkpoint");
}

static void require_checkpoint_place(const CheckpointOptions& options) {
  if (options.file.empty()) return;
  require_writable_file(options.file, "--checkpoint");
  if (std::filesystem::exists(options.file) && !is_checkpoint(options.file)) {
    throw UserError({"--checkpoint", 0, 0}, options.file + " is there and is no checkpoint",
                    "give another name");
  }
}

Run::Run(const std::string& command, const Scene& scene, const CommonOptions& options,
         const CheckpointOptions& checkpoints, std::optional<Resumed> resumed,
         const std::string& out)
    : command_(command),
      scene_(scene),
      quiet_(options.quiet),
      options_(checkpoints),
      file_(options_.file.empty() ? checkpoint_beside(out, options.scene)
                                  : std::filesystem::path(options_.file)),
      resumed_(std::move(resumed)),
      seed_(options.seed.value_or(resumed_ ? resumed_->checkpoint.seed : 1)) {
  require_checkpoint_place(options_);
  if (!resumed_) {
    simulation_ = simulation_of(scene, seed_);
    return;
  }
  simulation_ = std::make_unique<Simulation<2>>(model_of(scene, seed_), resumed_->checkpoint.saved);
  had_spins_ = !resumed_->checkpoint.saved.spins.empty();
  resumed_->checkpoint.saved = {};  // some memory
  const std::string laws = changed_laws(*resumed_, seed_);
  if (!laws.empty() && !quiet_) {
    std::fprintf(stderr, "clatter: from t = %g on other laws hold: %s\n", simulation_->time(),
                 laws.c_str());
  }
}

// Averages go on if there are any. Under another gravity they cannot, for what flights contribute
// is booked at their end, by the gravity of that time; nor where walls move otherwise, which starts
// flights anew; nor where spins come or go or get another inertia, for fields then need other sums
// and cells hold another energy.
bool Run::measures_anew() const {
  if (!resumed_) return false;
  if (resumed_->checkpoint.measurement.empty()) return true;
  if (!scene_.measure.fields.empty() &&
      (scene_.spins() != had_spins_ || differs(*resumed_, "disks.inertia"))) {
    return true;
  }
  std::vector<std::string> keys = {"gravity.acceleration"};
  for (const char* side : kSideNames) {
    for (const char* key : {"kind", "stroke", "frequency", "phase"}) {
      keys.push_back(std::string("walls.") + side + '.' + key);
    }
  }
  return std::ranges::any_of(keys, [&](const std::string& key) { return differs(*resumed_, key); });
}

Measurement& Run::measure(double end) {
  const double time = simulation_->time();
  if (!resumed_ || measures_anew()) {
    measurement_.emplace(*simulation_, scene_.measure, end);
    if (resumed_ && !quiet_) {
      std::fprintf(stderr, "clatter: averages start anew at t = %g\n",
                   std::max(time, scene_.measure.burn_in));
    }
    return *measurement_;
  }
  require_same_measure(*resumed_);
  std::string& saved = resumed_->checkpoint.measurement;
  measurement_.emplace(*simulation_, scene_.measure, ArchiveReader(saved, resumed_->file));
  saved.clear();
  return *measurement_;
}

bool Run::until(double time, Progress& progress) {
  constexpr std::chrono::milliseconds kSlice{100};
  std::uint64_t slice = 1024;  // steps, found while running
  ended_early_ = true;
  try {
    for (bool arrived = false; !arrived; progress.update(simulation_->time())) {
      if (interrupted()) return false;
      const auto began = Clock::now();
      arrived = simulation_->run_until(time, Simulation<2>::kNoLimit,
                                       simulation_->counts().steps() + slice);
      slice = Clock::now() - began < kSlice ? 2 * slice : std::max<std::uint64_t>(1, slice / 2);
      const std::chrono::duration<double> since_written = Clock::now() - last_written_;
      if (!options_.file.empty() && since_written.count() >= options_.every) write();
    }
  } catch (const PhysicalStop& stop) {
    stop_ = stop;
    return false;
  }
  ended_early_ = interrupted();
  return !ended_early_;
}

// A run does not fail for a checkpoint on the way: the next may succeed.
void Run::write() {
  Checkpoint checkpoint{.program = "clatter " CLATTER_VERSION,
                        .command = command_,
                        .scene = scene_to_toml(scene_),
                        .start_temperature = scene_.disks.start.temperature,
                        .seed = seed_,
                        .saved = simulation_->save(),
                        .measurement = {}};
  if (measurement_) checkpoint.measurement = measurement_->save();
  try {
    write_checkpoint(file_, checkpoint);
    failure_.clear();
  } catch (const RunError& error) {
    failure_ = error.what();
  }
  last_written_ = Clock::now();
}

void Run::put_aside() {
  if (!ended_early_ && options_.file.empty()) return;
  write();
  if (ended_early_ && !stop_ && failure_.empty() && !quiet_) {
    std::fprintf(stderr, "clatter: interrupted at t = %g; go on with --resume %s\n",
                 simulation_->time(), file_.c_str());
  }
}

// Throws where disks have overlapped by more than rounding: then events were lost.
static void require_no_overlap(double deepest) {
  constexpr double kRounding = 1e-9;  // diameters
  if (deepest <= kRounding) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", deepest);
  throw PhysicalStop(std::string("disks overlapped by ") + text +
                     " diameters: events were lost; please report this scene and seed");
}

int Run::end() {
  if (stop_) {
    const std::string remedy = stop_->remedy().empty() ? "" : " --set " + stop_->remedy();
    throw PhysicalStop(stop_->what() + (failure_.empty()
                                            ? "; go on with --resume " + file_.string() + remedy
                                            : "; no checkpoint is left: " + failure_));
  }
  require_no_overlap(simulation_->checks().deepest_overlap);
  // Also of a run that was interrupted: its exit code would say that all there is has been saved.
  if (!failure_.empty()) throw RunError("no checkpoint is left: " + failure_);
  return ended_early_ ? kInterrupted : kOk;
}

}  // namespace clatter
