#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/measure/measurement.h"

namespace clatter {

/// The names of all files that write_tables() may write.
std::vector<std::string> table_files();

/// Writes a measurement as CSV tables into a folder: the series of the temperature, and the
/// profile, the maps and the tables of observables if present. A table of maps has one line per
/// cell. A line that begins with "#" has the units. Cells without data have nan. Throws
/// Interrupted.
void write_tables(const std::filesystem::path& folder, const Measured& measured,
                  const StopRequest& stop = {});

}  // namespace clatter
