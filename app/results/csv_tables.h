#pragma once

#include <array>
#include <filesystem>

#include "engine/measure/measurement.h"

namespace clatter {

/// The names of all files that write_tables() may write.
inline constexpr std::array kTableNames = {"temperature_series.csv", "profile.csv", "maps.csv"};

/// Writes a measurement as CSV tables into a folder: the temperature's series, and, where it has
/// them, a profile, and maps, a line per cell. Units stand in a "#" line, nan in gaps.
void write_tables(const std::filesystem::path& folder, const Measured& measured);

}  // namespace clatter
