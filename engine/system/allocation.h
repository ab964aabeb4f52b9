#pragma once

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

}  // namespace clatter
