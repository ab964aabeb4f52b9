#pragma once

namespace clatter {

/// Installs the signal handlers. SIGINT, SIGTERM and SIGHUP request the end of the run, and so do
/// the warnings of batch systems: SIGUSR1, SIGUSR2, and SIGXCPU at the limit of CPU time. The run
/// then saves its state and results, and exits with code 130. A second SIGINT, SIGTERM or SIGHUP at
/// least 0.3 s later ends the program at once. A signal that is ignored at the start of the
/// program, as under nohup, stays ignored.
void catch_interrupts();

/// Makes a file beyond the size limit of the system a write error. The system would end the
/// program.
void refuse_large_files();

/// Blocks all signals in this thread, so that other threads handle them. A closed pipe then makes
/// write() fail, instead of ending the program with SIGPIPE.
void block_signals();

/// Whether a signal has requested the end of the run. A StopRequest for all long work.
bool interrupted();

}  // namespace clatter
