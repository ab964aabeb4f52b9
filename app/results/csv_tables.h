#pragma once

#include <array>
#include <filesystem>

#include "engine/measure/measurement.h"

namespace clatter {

/// The names of all files that write_tables() may write.
inline constexpr std::array kTableNames = {"temperature_series.csv", "profile.csv", "maps.csv"};

/// Writes a measurement as CSV tables into a folder: the series of the temperature, and the profile
/// and the maps if present. A table of maps has one line per cell. A line that begins with "#" has
/// the units. Cells without data have nan. Throws Interrupted.
void write_tables(const std::filesystem::path& folder, const Measured& measured,
                  const StopRequest& stop = {});

}  // namespace clatter
