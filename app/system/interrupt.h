#pragma once

namespace clatter {

/// Installs the signal handlers. SIGINT, SIGTERM and SIGHUP ask the run to end: it saves its
/// results and exits with 130. A second signal, 0.3 s later or more, ends the program at once.
/// SIGXFSZ is ignored: a file beyond the system's size limit is a write error.
void catch_interrupts();

/// Whether the run has been asked to end.
bool interrupted();

}  // namespace clatter
