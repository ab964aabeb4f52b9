#include "app/results/isolated_hdf5.h"

#include <algorithm>
#include <cstdint>
#include <system_error>

#include "engine/error.h"
#include "engine/system/allocation.h"
#include "engine/system/isolated.h"

namespace clatter {

// Deflate makes no data smaller than a thousandth, and a frame is copied some ten times: by the
// library, as numbers, as vectors and for the pipe.
static WorkLimits limits_for(std::uintmax_t file_size) {
  constexpr double kMemory = 2e9, kMemoryPerByte = 1e4;                // bytes
  constexpr double kTime = 20.0, kTimePerByte = 1e-5, kLongest = 1e8;  // s
  constexpr int kIdle = 10;                                            // of processor times
  const auto bytes = static_cast<double>(file_size);
  const double memory =
      std::min(kMemory + kMemoryPerByte * bytes, std::max(kMemory, available_memory()));
  const int time = static_cast<int>(std::min(kTime + kTimePerByte * bytes, kLongest));
  return {.memory = static_cast<std::uint64_t>(memory),
          .processor_time = time,
          .idle_time = kIdle * time};
}

std::string read_hdf5_apart(const std::filesystem::path& path,
                            const std::function<std::string()>& read) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const WorkOutcome outcome = run_isolated(read, limits_for(error ? 0 : size));
  if (outcome.failure.empty()) return outcome.bytes;
  throw UserError({path.string()}, "the HDF5 library " + outcome.failure,
                  "check the file with h5dump, or write it again");
}

}  // namespace clatter
