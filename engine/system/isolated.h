#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace clatter {

/// Limits of isolated work. They stop runaway work only, so they must suffice on slow machines.
struct WorkLimits {
  std::uint64_t memory = 0;  ///< bytes of address space; a program with a sanitizer has no limit
  int processor_time = 0;    ///< s
  int idle_time = 0;         ///< s during which the work returns nothing
};

/// The outcome of isolated work.
struct WorkOutcome {
  std::string bytes;    ///< its result
  std::string failure;  ///< why it has no result, as in "crashed (Aborted)"; empty: it has one
};

/// Runs a function in a child process, which has a copy of the memory. So crashes, endless loops
/// and huge allocations end only the child. Throws the UserError or RunError of the function, and
/// RunError for its other errors or if no process can start. No other thread may hold a lock that
/// the function needs.
WorkOutcome run_isolated(const std::function<std::string()>& work, const WorkLimits& limits);

}  // namespace clatter
