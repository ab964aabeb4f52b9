#include "app/sweep/run_one.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <string_view>
#include <thread>

#include "app/measure/measure_run.h"
#include "app/system/exit_code.h"
#include "engine/error.h"
#include "engine/system/signals.h"

namespace clatter {

static bool is_present(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

static MeasureOptions options_of(const SweepFolder& folder, int id, ProgressStyle progress) {
  constexpr double kCheckpointInterval = 60.0;  // seconds
  const Sweep sweep = folder.sweep();
  const SweepRun run = folder.run(id);
  MeasureOptions options;
  options.common.scene = folder.scene();
  for (const Override& setting : sweep.settings_at(run.settings)) {
    options.common.settings.push_back(setting.key + '=' + setting.value);
  }
  options.common.seed = run.seed;
  options.common.until = sweep.until;
  options.common.quiet = progress != ProgressStyle::Auto;
  options.common.progress = progress;
  options.checkpoints.file = folder.checkpoint(id);
  options.checkpoints.every = kCheckpointInterval;
  options.checkpoints.of_end = false;  // the result follows, or an error with a checkpoint
  if (is_present(options.checkpoints.file)) options.checkpoints.resume = options.checkpoints.file;
  options.accuracy = sweep.accuracy;
  options.out = folder.part(id);
  return options;
}

// A checkpoint that cannot be used has its own fix: `clatter sweep run` has no flag --resume.
static SweepFailure failure_of(const UserError& error, const std::string& checkpoint) {
  if (checkpoint.empty() || !std::string_view(error.what()).starts_with(checkpoint + ':')) {
    return {kWrongUse, error.what()};
  }
  return {kWrongUse,
          checkpoint + ": " + error.problem() + "; remove it, and start the sweep again"};
}

// Measures, and turns an error into the reason of the failure.
static SweepFailure attempt(const MeasureOptions& options) {
  try {
    return {measure(options), ""};
  } catch (const Interrupted&) {
    return {kInterrupted, ""};
  } catch (const UserError& error) {
    return failure_of(error, options.checkpoints.resume);
  } catch (const PhysicalStop& error) {
    return {kPhysicalStop, error.what()};
  } catch (const std::bad_alloc&) {
    return {kFailed, "out of memory"};
  } catch (const std::exception& error) {
    return {kFailed, error.what()};
  }
}

// False after an interrupt.
static bool wait_for_lock(SweepFolder& folder, int id) {
  constexpr std::chrono::milliseconds kPause{100};
  for (bool told = false; !folder.lock(id); told = true) {
    if (interrupted()) return false;
    if (!told) std::fprintf(stderr, "note: another process measures run %d; waiting for it\n", id);
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

int measure_run(SweepFolder& folder, int id, ProgressStyle progress) {
  catch_interrupts();
  if (!wait_for_lock(folder, id)) return kInterrupted;
  SweepFailure outcome;
  if (!folder.has_result(id)) {
    outcome = attempt(options_of(folder, id, progress));
    if (outcome.code == kOk) {
      folder.publish(id);
    } else if (outcome.code != kInterrupted) {
      std::fprintf(stderr, "clatter: run %d: %s\n", id, outcome.reason.c_str());
      folder.fail(id, outcome);
    }
  }
  folder.unlock(id);
  return outcome.code;
}

}  // namespace clatter
