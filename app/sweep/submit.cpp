#include "app/sweep/submit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "app/measure/feature_cost.h"
#include "app/sweep/executor.h"
#include "app/system/outputs.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

// Runs without result in groups of this size, each as a word such as "17,20-25".
std::vector<std::string> chunks_of(const SweepFolder& folder, std::size_t size) {
  const std::vector<int> open = SweepState(folder).wanted;
  std::vector<std::string> chunks;
  for (std::size_t begin = 0; begin < open.size(); begin += size) {
    const std::size_t end = std::min(begin + size, open.size());
    std::string word;
    for (std::size_t k = begin; k < end; ++k) {
      std::size_t last = k;
      while (last + 1 < end && open[last + 1] == open[last] + 1) ++last;
      word += (word.empty() ? "" : ",") + std::to_string(open[k]);
      if (last > k) word += '-' + std::to_string(open[last]);
      k = last;
    }
    chunks.push_back(word);
  }
  return chunks;
}

}  // namespace

double run_memory(const SweepFolder& folder) {
  constexpr double kProgram = 1e8, kMargin = 1.5;
  const Sweep sweep = folder.sweep();
  double most = 0.0;
  std::set<std::string> seen;
  for (const SweepRun& run : folder.runs()) {
    if (!seen.insert(settings_text(run.settings)).second) continue;
    try {
      const Scene scene = load_scene(folder.scene(), sweep.settings_at(run.settings));
      most = std::max(most, memory_of(scene));
    } catch (const UserError&) {
      // The run will report it.
    }
  }
  return kProgram + kMargin * most;
}

std::string parallel_line(const SweepFolder& folder, int chunk) {
  const auto chunks = chunks_of(folder, static_cast<std::size_t>(std::max(1, chunk)));
  if (chunks.empty()) return "";
  const std::string name = folder.path().string();
  if (name.find_first_of("{}") != name.npos) {
    throw UserError({name}, "GNU parallel replaces braces in the name of this folder",
                    "rename it without braces");
  }
  std::string line = "parallel clatter sweep run " + shell_word(shell_word(name)) + " :::";
  for (const std::string& word : chunks) line += ' ' + word;
  return line + '\n';
}

std::filesystem::path write_batch_script(const SweepFolder& folder, int chunk,
                                         const TaskLimits& limits) {
  constexpr std::size_t kMostTasks = 1000;
  const std::size_t open = SweepState(folder).wanted.size();
  const std::optional<std::size_t> most = most_array_tasks();
  const auto size_for = [open](std::size_t tasks) {
    return std::max<std::size_t>(1, (open + tasks - 1) / tasks);
  };
  const std::size_t size = chunk > 0 ? static_cast<std::size_t>(chunk)
                                     : size_for(std::min(kMostTasks, most.value_or(kMostTasks)));
  ArrayJob job;
  job.folder = std::filesystem::absolute(folder.path()) / "slurm";
  job.tasks = chunks_of(folder, size);
  if (job.tasks.empty()) return {};
  require_array_size(job, most, "--chunk",
                     "give at least --chunk " + std::to_string(size_for(most.value_or(1))));
  job.body = program_word() + " sweep run " +
             shell_word(std::filesystem::absolute(folder.path()).string()) +
             " \"$task\" --progress none";
  job.megabytes = std::ceil(1e-6 * run_memory(folder));
  job.limits = limits;
  const std::string script = batch_script(job);
  make_folder(job.folder, "slurm");
  write_file(job.folder / "job.sh", script);
  return job.folder / "job.sh";
}

}  // namespace clatter
