#include "app/sweep/submit.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <set>

#include "app/runs/feature_cost.h"
#include "app/sweep/executor.h"
#include "app/system/outputs.h"
#include "engine/error.h"
#include "engine/scene/scene_file.h"
#include "engine/system/platform.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

// A word for the shell, in single quotes.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// The path of a file in an option of a batch script. Throws UserError if Slurm cannot read it.
std::string option_path(const std::filesystem::path& path) {
  const std::string text = path.string();
  if (text.find_first_of("\"\n\\") != text.npos) {
    throw UserError({text}, "a batch script cannot name this folder",
                    "rename it without quotation marks, backslashes and line breaks");
  }
  std::string escaped;  // % begins a replacement symbol
  for (const char c : text) escaped += c == '%' ? std::string("%%") : std::string(1, c);
  return escaped;
}

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

// Megabytes that the largest run needs.
double memory_of(const SweepFolder& folder) {
  constexpr double kProgram = 100.0, kMargin = 1.5;
  const Sweep sweep = folder.sweep();
  double most = 0.0;
  std::set<std::string> seen;
  for (const SweepRun& run : folder.runs()) {
    if (!seen.insert(settings_text(run.settings)).second) continue;
    double bytes = 0.0;
    try {
      for (const FeatureCost& part :
           feature_costs(load_scene(folder.scene(), sweep.settings_at(run.settings)))) {
        bytes += part.bytes;
      }
    } catch (const UserError&) {
      continue;  // the run will report it
    }
    most = std::max(most, bytes);
  }
  return std::ceil(kProgram + kMargin * 1e-6 * most);
}

}  // namespace

std::string parallel_line(const SweepFolder& folder, int chunk) {
  const auto chunks = chunks_of(folder, static_cast<std::size_t>(std::max(1, chunk)));
  if (chunks.empty()) return "";
  std::string line =
      "parallel clatter sweep run " + shell_word(shell_word(folder.path().string())) + " :::";
  for (const std::string& word : chunks) line += ' ' + word;
  return line + '\n';
}

std::filesystem::path write_batch_script(const SweepFolder& folder, const TaskLimits& limits) {
  constexpr std::size_t kMostTasks = 1000;  // Slurm's default is 1001
  const std::size_t open = SweepState(folder).wanted.size();
  const std::size_t chunk = limits.chunk > 0 ? static_cast<std::size_t>(limits.chunk)
                                             : (open + kMostTasks - 1) / kMostTasks;
  const std::vector<std::string> chunks = chunks_of(folder, std::max<std::size_t>(1, chunk));
  if (chunks.empty()) return {};
  const auto place = std::filesystem::absolute(folder.path()) / "slurm";
  make_folder(place, "slurm");
  std::error_code ignored;
  const auto program = std::filesystem::canonical(this_program("clatter"), ignored);
  std::string script = "#!/bin/bash\n";
  const auto option = [&](const std::string& text) { script += "#SBATCH " + text + '\n'; };
  option("--job-name=clatter");
  option(fmt::format("--array=1-{}", chunks.size()));
  option("--ntasks=1");
  option("--cpus-per-task=1");
  option(fmt::format("--mem={:.0f}M", memory_of(folder)));
  if (!limits.time.empty()) option("--time=" + limits.time);
  if (!limits.partition.empty()) option("--partition=" + limits.partition);
  option("--requeue");
  option("--signal=B:USR1@60");
  option("--open-mode=append");
  option(fmt::format("--output=\"{}/%a.log\"", option_path(place)));
  script += "chunks=(\n";
  for (const std::string& word : chunks) script += "  " + word + '\n';
  script += fmt::format(R"()
folder={}
{} sweep run "$folder" "${{chunks[SLURM_ARRAY_TASK_ID - 1]}}" --progress none &
process=$!
# A run that receives SIGTERM writes its checkpoint and ends with code 130.
stop() {{
  kill -TERM $process
  again=$1
}}
trap 'stop no' TERM
trap 'stop yes' USR1
again=no
# A signal ends `wait` before the process has ended.
while wait $process; code=$?; kill -0 $process 2>/dev/null; do :; done
if [[ $again == yes ]]; then
  exec scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit $code
)",
                        shell_word(std::filesystem::absolute(folder.path()).string()),
                        shell_word(program.empty() ? "clatter" : program.string()));
  write_file(place / "job.sh", script);
  return place / "job.sh";
}

void submit_batch(const std::filesystem::path& script) {
  execlp("sbatch", "sbatch", script.c_str(), nullptr);
  throw RunError(std::string("cannot start sbatch: ") + std::strerror(errno) + "; the script is " +
                 script.string());
}

}  // namespace clatter
