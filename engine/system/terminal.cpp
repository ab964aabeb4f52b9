#include "engine/system/terminal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace clatter {

// open() returns the lowest free number.
void open_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) open("/dev/null", O_RDONLY);
  }
}

bool error_is_terminal() {
  return isatty(STDERR_FILENO);
}

}  // namespace clatter
