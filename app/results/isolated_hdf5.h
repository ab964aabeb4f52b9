#pragma once

#include <filesystem>
#include <functional>
#include <string>

// libhdf5 crashes on some damaged files, and reads others for ever. So a child process reads HDF5
// files (read_hdf5_apart), with limits of memory and time that grow with the file. Its end by a
// signal or a limit is a UserError. Errors of the reader pass through a pipe, and so does the
// frame. The process has one thread at that time.

namespace clatter {

/// Runs a function that reads an HDF5 file, in a child process. The library crashes on some damaged
/// files, and reads others for ever. Throws UserError for these, and the UserError or RunError of
/// the function.
std::string read_hdf5_apart(const std::filesystem::path& path,
                            const std::function<std::string()>& read);

}  // namespace clatter
