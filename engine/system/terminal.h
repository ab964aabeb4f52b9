#pragma once

namespace clatter {

/// Opens /dev/null for reading in place of each closed standard stream: input, output or error.
/// Writes to it fail, as on a closed stream. Otherwise the first opened file would get the number
/// of the stream, and messages would go into this file.
void open_standard_streams();

/// Whether standard error is a terminal.
bool error_is_terminal();

}  // namespace clatter
