#pragma once

namespace clatter {

/// Installs the signal handlers. SIGINT, SIGTERM and SIGHUP request the end of the run. The run
/// then saves its state and results, and exits with code 130. A second signal at least 0.3 s later
/// ends the program at once.
void catch_interrupts();

/// Whether a signal has requested the end of the run. A StopRequest for all long work.
bool interrupted();

}  // namespace clatter
