#pragma once

#include <filesystem>

#include "engine/measure/measurement.h"

namespace clatter {

/// Writes the series and the profiles of a measurement as CSV tables into a folder:
/// temperature_series.csv, and profile.csv where there is one. Units stand in a "#" line.
void write_tables(const std::filesystem::path& folder, const Measured& measured);

}  // namespace clatter
