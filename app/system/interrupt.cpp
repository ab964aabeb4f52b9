#include "app/system/interrupt.h"

#include <time.h>

#include <atomic>
#include <csignal>

namespace clatter {

// Time of the request to end the run, in milliseconds; 0: no request. A signal handler may write a
// lock-free atomic only.
static std::atomic<long long> asked_to_end = 0;
static_assert(decltype(asked_to_end)::is_always_lock_free);

static long long milliseconds() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000LL * now.tv_sec + now.tv_nsec / 1'000'000 + 1;
}

// timeout(1) signals the program and then its process group, which contains the program. Two
// signals within a short time are one request.
static void ask_to_end(int signal) {
  constexpr long long kOneSignal = 300;
  const long long now = milliseconds();
  long long first = 0;
  if (asked_to_end.compare_exchange_strong(first, now) || now - first < kOneSignal) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void catch_interrupts() {
  std::signal(SIGINT, ask_to_end);
  std::signal(SIGTERM, ask_to_end);
  std::signal(SIGHUP, ask_to_end);
  // A long run whose reader has ended reports this as an error, and writes its checkpoint.
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() {
  return asked_to_end != 0;
}

}  // namespace clatter
