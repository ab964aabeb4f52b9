#pragma once

namespace clatter {

/// From now on SIGINT, SIGTERM and SIGHUP only ask the run to end: it saves what there is and the
/// program exits with 130. Another signal, not right after the first, ends the program at once. A
/// file that grows beyond the system's limit is an error of writing and not a signal (SIGXFSZ).
void catch_interrupts();

/// Whether the run has been asked to end.
bool interrupted();

}  // namespace clatter
