#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace clatter {

/// Runs a function that reads an HDF5 file, in a child process. The library crashes on some damaged
/// files, and reads others for ever. Throws UserError for these, and the UserError or RunError of
/// the function.
std::string read_hdf5_apart(const std::filesystem::path& path,
                            const std::function<std::string()>& read);

}  // namespace clatter
