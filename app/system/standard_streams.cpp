#include "app/system/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace clatter {

// The lowest number that is free is the one that open() gives.
void open_standard_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) open("/dev/null", O_RDONLY);
  }
}

}  // namespace clatter
