#include "app/sweep/executor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <exception>
#include <iterator>
#include <list>
#include <string_view>
#include <thread>

#include "app/measure/measure_run.h"
#include "app/system/exit_code.h"
#include "app/system/program_job.h"
#include "engine/error.h"
#include "engine/system/signals.h"
#include "engine/system/terminal.h"

namespace clatter {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// A process that measures some runs, one after the other.
struct Job {
  std::vector<int> ids;
  Clock::time_point began;
  ProgramJob program;
  std::size_t ended = 0;  // number of ids that have a result or a failure

  Job(const SweepFolder& folder, std::vector<int> runs)
      : ids(std::move(runs)), began(Clock::now()), program(command(folder, ids)) {}

  static std::vector<std::string> command(const SweepFolder& folder, const std::vector<int>& ids) {
    // The folder is absolute, because a name such as -d would be a flag.
    const std::string path = std::filesystem::absolute(folder.path()).string();
    std::vector<std::string> words = {"clatter", "sweep", "run", path, "--progress", "json"};
    for (const int id : ids) words.push_back(std::to_string(id));
    return words;
  }
};

class Executor {
 public:
  Executor(const SweepFolder& folder, int processes, ProgressStyle style)
      : folder_(folder),
        processes_(static_cast<std::size_t>(processes)),
        style_(style),
        terminal_(style == ProgressStyle::Auto && error_is_terminal()) {
    SweepState state(folder);
    runs_ = std::move(state.runs);
    open_.assign(state.wanted.begin(), state.wanted.end());
    done_before_ = runs_.size() - open_.size();
    wanted_ = open_.size();
  }

  void run() {
    while (true) {
      if (interrupted() && !stopping_) {
        stopping_ = true;
        for (const Job& job : jobs_) job.program.interrupt();
      }
      while (!stopping_ && jobs_.size() < processes_ && !open_.empty()) start();
      if (jobs_.empty()) break;
      wait();
      for (auto job = jobs_.begin(); job != jobs_.end();) {
        const std::optional<int> code = job->program.poll();
        count_ended(*job);
        if (code) finish(*job, *code);
        job = code ? jobs_.erase(job) : std::next(job);
      }
      show();
    }
    if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
  }

  // Whether a process has ended without result and without a reason.
  bool broken() const { return broken_; }

 private:
  // Short runs share a process, so that starts of processes cost little.
  void start() {
    constexpr double kLeastSeconds = 5.0;
    constexpr double kMostRuns = 100.0;
    const double share = static_cast<double>(open_.size()) / (2.0 * processes_);
    const double fitting = run_seconds_ > 0.0 ? kLeastSeconds / run_seconds_ : 1.0;
    const auto count =
        static_cast<std::size_t>(std::max(1.0, std::min({share, fitting, kMostRuns})));
    std::vector<int> ids(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(count));
    open_.erase(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(count));
    for (const int id : ids) folder_.forget_failure(id);  // else has_ended() would be true
    jobs_.emplace_back(folder_, std::move(ids));
  }

  void wait() const {
    constexpr std::chrono::milliseconds kLongest{200};
    std::vector<const ChildProcess*> processes;
    for (const Job& job : jobs_) processes.push_back(&job.program.process());
    wait_for_any(processes, kLongest);
  }

  bool has_ended(int id) const { return folder_.has_result(id) || folder_.failure(id); }

  void count_ended(Job& job) {
    while (job.ended < job.ids.size() && has_ended(job.ids[job.ended])) {
      ++job.ended;
      ++ended_;
    }
  }

  // The first run without an end has broken the process. The others of the process are open again.
  void finish(const Job& job, int code) {
    if (job.ended > 0) run_seconds_ = seconds_since(job.began) / static_cast<double>(job.ended);
    if (job.ended == job.ids.size() || interrupted()) return;
    broken_ = true;
    const int id = job.ids[job.ended];
    // The last message may be that of an earlier run.
    std::string reason = job.program.process().signal();
    if (reason.empty() && code == kInterrupted) reason = "it was interrupted";
    if (reason.empty()) reason = job.program.message();
    if (reason.empty()) reason = fmt::format("exit code {}", code);
    std::fprintf(stderr, "%sclatter: %s has ended without a result: %s\n",
                 terminal_ ? "\r\033[K" : "",
                 name_of(runs_[static_cast<std::size_t>(id) - 1]).c_str(), reason.c_str());
    open_.insert(open_.begin(), job.ids.begin() + static_cast<std::ptrdiff_t>(job.ended) + 1,
                 job.ids.end());
  }

  void show() {
    if (style_ == ProgressStyle::None || wanted_ == 0 || jobs_.empty()) return;
    if (seconds_since(last_shown_) < (terminal_ ? 0.2 : 5.0)) return;
    last_shown_ = Clock::now();
    double work = static_cast<double>(ended_);
    const Job* slowest = &jobs_.front();
    for (const Job& job : jobs_) {
      if (job.ended < job.ids.size()) work += job.program.done();
      if (job.began < slowest->began) slowest = &job;
    }
    const double share = work / static_cast<double>(wanted_);
    const double left = share > 0.0 ? seconds_since(began_) * (1.0 - share) / share : 0.0;
    const std::size_t done = done_before_ + ended_;
    if (style_ == ProgressStyle::Json) {
      std::fprintf(stderr, "{\"ended\":%zu,\"runs\":%zu,\"done\":%.6f,\"seconds_left\":%.1f}\n",
                   done, runs_.size(), share, left);
      return;
    }
    const std::size_t at = std::min(slowest->ended, slowest->ids.size() - 1);
    const SweepRun& run = runs_[static_cast<std::size_t>(slowest->ids[at]) - 1];
    std::fprintf(stderr, "%ssweep: %zu of %zu runs, %s left; slowest: %s, %s%s",
                 terminal_ ? "\r\033[K" : "", done, runs_.size(), spell_seconds(left).c_str(),
                 name_of(run).c_str(), spell_seconds(seconds_since(slowest->began)).c_str(),
                 terminal_ ? "" : "\n");
    shown_ = true;
  }

  const SweepFolder& folder_;
  std::size_t processes_;
  ProgressStyle style_;
  bool terminal_;
  std::vector<SweepRun> runs_;
  std::deque<int> open_;         // runs to start
  std::list<Job> jobs_;          // current processes
  std::size_t wanted_ = 0;       // number of runs to measure
  std::size_t done_before_ = 0;  // number of runs that ended earlier
  std::size_t ended_ = 0;        // number of runs that ended now
  double run_seconds_ = 0.0;     // of a recent run; 0: unknown
  bool stopping_ = false;
  bool broken_ = false;
  bool shown_ = false;
  Clock::time_point began_ = Clock::now();
  Clock::time_point last_shown_ = began_;
};

}  // namespace

// The runs come last: another process may add some, and no number may be beyond them.
SweepState::SweepState(const SweepFolder& folder)
    : failed(folder.failed()), done(folder.done()), runs(folder.runs()) {
  // A kill after the write of a result may leave the failure of an earlier attempt.
  std::erase_if(failed, [&](int id) { return std::ranges::binary_search(done, id); });
  std::vector<int> ended;
  std::ranges::set_union(done, failed, std::back_inserter(ended));
  for (const SweepRun& run : runs) {
    if (!std::ranges::binary_search(ended, run.id)) open.push_back(run.id);
  }
  wanted = open;
  for (const int id : failed) {
    const auto failure = folder.failure(id);
    if (!failure || !failure->is_final()) wanted.push_back(id);
  }
  std::ranges::sort(wanted);
}

std::string name_of(const SweepRun& run) {
  const std::string settings = settings_text(run.settings);
  return fmt::format("run {} ({}seed {})", run.id, settings.empty() ? "" : settings + ", ",
                     run.seed);
}

void print_state(const SweepFolder& folder) {
  const SweepState state(folder);
  std::fprintf(stderr, "sweep: %zu runs: %zu with result, %zu failed, %zu open\n",
               state.runs.size(), state.done.size(), state.failed.size(), state.open.size());
  for (const int id : state.failed) {
    const auto failure = folder.failure(id);
    if (!failure) continue;
    std::fprintf(stderr, "  %s failed: %s\n",
                 name_of(state.runs[static_cast<std::size_t>(id) - 1]).c_str(),
                 failure->reason.c_str());
  }
}

int execute_sweep(const SweepFolder& folder, int processes, ProgressStyle style) {
  catch_interrupts();
  Executor executor(folder, processes, style);
  executor.run();
  const SweepState state(SweepFolder(folder.path()));  // throws if the folder has been removed
  const bool complete = state.done.size() == state.runs.size();
  const bool failed = !complete && !interrupted();
  if (style != ProgressStyle::None || failed) print_state(folder);
  if (!complete && interrupted()) {
    std::fputs("clatter: interrupted; the same command continues the sweep\n", stderr);
    return kInterrupted;
  }
  return complete && !executor.broken() ? kOk : kFailed;
}

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
