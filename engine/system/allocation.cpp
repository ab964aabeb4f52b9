#include "engine/system/allocation.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>

#include "engine/system/platform.h"
#include "engine/whole_number.h"

namespace clatter {

int processors() {
  const char* task = std::getenv("SLURM_CPUS_PER_TASK");
  const int allowed = whole_number<int>(task ? task : "").value_or(0);
  return allowed > 0 ? std::min(allowed, machine_processors()) : machine_processors();
}

double available_memory() {
  double memory = machine_memory();
  for (const int resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
      memory = std::min(memory, static_cast<double>(limit.rlim_cur));
    }
  }
  return memory;
}

int fitting_processors(double bytes) {
  return static_cast<int>(std::clamp(available_memory() / bytes, 1.0, 1.0 * processors()));
}

}  // namespace clatter
