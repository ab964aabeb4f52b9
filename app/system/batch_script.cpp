#include "app/system/batch_script.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <sstream>
#include <string_view>

#include "engine/error.h"
#include "engine/system/child_process.h"
#include "engine/system/platform.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

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

}  // namespace

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string program_word() {
  std::error_code ignored;
  const auto program = std::filesystem::canonical(this_program("clatter"), ignored);
  return shell_word(program.empty() ? "clatter" : program.string());
}

std::string batch_script(const ArrayJob& job) {
  const std::filesystem::path folder = std::filesystem::absolute(job.folder);
  std::string script = "#!/bin/bash\n";
  const auto option = [&](const std::string& text) { script += "#SBATCH " + text + '\n'; };
  option("--job-name=clatter");
  option(fmt::format("--array=1-{}", job.tasks.size()));
  option("--ntasks=1");
  option(fmt::format("--cpus-per-task={}", job.processors));
  option(fmt::format("--mem={:.0f}M", job.megabytes));
  if (!job.limits.time.empty()) option("--time=" + job.limits.time);
  if (!job.limits.partition.empty()) option("--partition=" + job.limits.partition);
  option("--requeue");
  option("--signal=B:USR1@60");
  option("--open-mode=append");
  option(fmt::format("--output=\"{}/%a.log\"", option_path(folder)));
  script += "tasks=(\n";
  for (const std::string& word : job.tasks) script += "  " + word + '\n';
  script += fmt::format(R"()
task=${{tasks[SLURM_ARRAY_TASK_ID - 1]}}
folder={}
{} &
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
)",
                        shell_word(folder.string()), job.body);
  if (!job.after.empty()) script += "((code == 0)) || exit $code\n" + job.after;
  return script + "exit $code\n";
}

// The limit is one more than the largest number of a task. ChildProcess keeps standard error only.
std::optional<std::size_t> most_array_tasks() {
  constexpr std::string_view kName = "MaxArraySize";
  ChildProcess program({"/bin/sh", "-c", "exec scontrol show config >&2 2>/dev/null"});
  program.wait();
  std::istringstream lines(program.new_words());
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(kName)) continue;
    const std::size_t value = line.find_last_of(" =") + 1;
    const auto size = whole_number<std::size_t>(std::string_view(line).substr(value));
    if (size && *size > 1) return *size - 1;
  }
  return std::nullopt;
}

void require_array_size(const ArrayJob& job, std::optional<std::size_t> most, const char* flag,
                        const std::string& advice) {
  if (!most || job.tasks.size() <= *most) return;
  throw UserError({flag, 0, 0},
                  fmt::format("the array job would have {} tasks, and this cluster allows {}",
                              job.tasks.size(), *most),
                  advice);
}

void submit_batch(const std::filesystem::path& script) {
  continue_as("sbatch", script.c_str());
  throw RunError(std::string("cannot start sbatch: ") + std::strerror(errno) + "; the script is " +
                 script.string());
}

}  // namespace clatter
