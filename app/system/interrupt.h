#pragma once

namespace clatter {

/// Installs the signal handlers. SIGINT, SIGTERM and SIGHUP request the end of the run, and so do
/// the warnings of batch systems: SIGUSR1, SIGUSR2, and SIGXCPU at the limit of CPU time. The run
/// then saves its state and results, and exits with code 130. A second SIGINT, SIGTERM or SIGHUP at
/// least 0.3 s later ends the program at once. A signal that is ignored at the start of the
/// program, as under nohup, stays ignored.
void catch_interrupts();

/// Whether a signal has requested the end of the run. A StopRequest for all long work.
bool interrupted();

}  // namespace clatter
