#include <csignal>

#include "app/commands/commands.h"
#include "app/system/standard_streams.h"

int main(int argc, char** argv) {
  clatter::open_standard_streams();
  // A file beyond the size limit of the system becomes a write error.
  std::signal(SIGXFSZ, SIG_IGN);
  return clatter::run_program(argc, argv);
}
