#pragma once

#include <filesystem>
#include <limits>

namespace clatter {

/// Number of processors that this process may use, at least 1: those of machine_processors(), and
/// of its Slurm task ($SLURM_CPUS_PER_TASK).
int processors();

/// Memory that this process may use, in bytes: machine_memory(), or the limits of the shell if they
/// are lower (ulimit -v, -d).
double available_memory();

/// Number of processes or threads, at least 1 and at most processors(), that have room in
/// available_memory() if each needs so many bytes.
int fitting_processors(double bytes);

/// Limits of Linux control groups; infinity: none.
struct GroupLimits {
  double processors = std::numeric_limits<double>::infinity();  ///< CPU time per time
  double memory = std::numeric_limits<double>::infinity();      ///< bytes
};

/// The least limits of the control groups of this process and of all groups above them, of both
/// versions (cgroups(7)). `root` is the folder of proc, and of the folders where proc says that the
/// groups are mounted. No limits where it has none.
GroupLimits control_group_limits(const std::filesystem::path& root = "/");

}  // namespace clatter
