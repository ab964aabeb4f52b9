#include "engine/system/signals.h"

#include <time.h>

#include <atomic>
#include <csignal>

#include "engine/system/child_process.h"

namespace clatter {

// Whether a signal has requested the end, and the time of the first that was no warning, in
// milliseconds; 0: none. A signal handler may write a lock-free atomic only.
static std::atomic<bool> asked_to_end = false;
static std::atomic<long long> first_asked = 0;
static_assert(decltype(asked_to_end)::is_always_lock_free &&
              decltype(first_asked)::is_always_lock_free);

static long long milliseconds() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000LL * now.tv_sec + now.tv_nsec / 1'000'000 + 1;
}

// Batch systems repeat a warning, SIGXCPU every second, or send SIGTERM some time after it.
static bool is_warning(int signal) {
  return signal == SIGXCPU || signal == SIGUSR1 || signal == SIGUSR2;
}

// timeout(1) signals the program and then its process group, which contains the program. Two
// signals within a short time are one request.
static void ask_to_end(int signal) {
  constexpr long long kOneSignal = 300;
  asked_to_end = true;
  if (is_warning(signal)) return;
  const long long now = milliseconds();
  long long first = 0;
  if (first_asked.compare_exchange_strong(first, now) || now - first < kOneSignal) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void catch_interrupts() {
  for (const int signal : kInterrupts) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) std::signal(signal, ask_to_end);
  }
  // A long run whose reader has ended reports this as an error, and writes its checkpoint.
  std::signal(SIGPIPE, SIG_IGN);
}

void refuse_large_files() {
  std::signal(SIGXFSZ, SIG_IGN);
}

void block_signals() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, nullptr);
}

bool interrupted() {
  return asked_to_end;
}

}  // namespace clatter
