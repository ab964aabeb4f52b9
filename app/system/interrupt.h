#pragma once

namespace clatter {

/// From now on SIGINT and SIGTERM only ask the run to end: it saves what there is and the program
/// exits with 130. Another signal, not right after the first, ends the program at once.
void catch_interrupts();

/// Whether the run has been asked to end.
bool interrupted();

}  // namespace clatter
