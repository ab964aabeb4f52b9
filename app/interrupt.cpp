#include "app/interrupt.h"

#include <csignal>

namespace clatter {

// The one thing that a signal handler may touch.
static volatile std::sig_atomic_t asked_to_end = 0;

static void ask_to_end(int signal) {
  asked_to_end = 1;
  std::signal(signal, SIG_DFL);
}

void catch_interrupts() {
  std::signal(SIGINT, ask_to_end);
  std::signal(SIGTERM, ask_to_end);
}

bool interrupted() {
  return asked_to_end != 0;
}

}  // namespace clatter
