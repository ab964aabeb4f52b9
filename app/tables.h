#pragma once

#include <filesystem>

#include "engine/measure/measurement.h"

namespace clatter {

/// Writes a measurement as CSV tables into a folder: temperature_series.csv, and, where there are
/// fields, profile.csv and maps.csv, a line per cell. Units stand in a "#" line, nan in gaps.
void write_tables(const std::filesystem::path& folder, const Measured& measured);

}  // namespace clatter
