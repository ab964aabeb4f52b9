#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clatter {

/// Limits of the tasks of an array job.
struct TaskLimits {
  std::string time;       ///< time limit as for sbatch --time; empty: that of the partition
  std::string partition;  ///< partition of the cluster; empty: the default
};

/// An array job for Slurm. A task that receives SIGTERM, or SIGUSR1 before its time limit, passes
/// SIGTERM to its process, which writes a checkpoint. After SIGUSR1 it queues itself again.
struct ArrayJob {
  std::filesystem::path folder;    ///< folder of the script and of the logs, relative or absolute
  std::vector<std::string> tasks;  ///< a word per task; the script has it as $task
  std::string body;  ///< Bash lines; the last command is the process of a task. $folder: the folder
  std::string after;       ///< Bash lines that follow a successful process; empty: none
  double megabytes = 0.0;  ///< memory of a task
  int processors = 1;      ///< processors of a task
  TaskLimits limits;
};

/// A word for the shell, in single quotes.
std::string shell_word(const std::string& text);

/// The path of this program as a word for the shell.
std::string program_word();

/// The text of the batch script. Throws UserError if Slurm cannot read the name of the folder.
std::string batch_script(const ArrayJob& job);

/// The most tasks of an array job on this cluster, from `scontrol show config`; absent if Slurm
/// does not answer.
std::optional<std::size_t> most_array_tasks();

/// Throws UserError with the flag and the advice if an array job has more tasks than `most`, the
/// result of most_array_tasks().
void require_array_size(const ArrayJob& job, std::optional<std::size_t> most, const char* flag,
                        const std::string& advice);

/// Replaces this process by sbatch for this script. Throws RunError if there is no sbatch.
[[noreturn]] void submit_batch(const std::filesystem::path& script);

}  // namespace clatter
