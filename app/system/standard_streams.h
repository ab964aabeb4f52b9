#pragma once

namespace clatter {

/// Opens /dev/null as each of the standard input, output and error that the program was started
/// without, for reading only: writing fails as it did. Else the first file that the program opens
/// would get that number, and messages would go into it.
void open_standard_streams();

}  // namespace clatter
