#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "engine/measure/measurement.h"

namespace clatter {

/// Writes a measurement as an HDF5 file. It has the names of the result file: objects are groups,
/// numbers, texts and lists their attributes, so that the group "scene" holds the resolved scene;
/// but series and profile are datasets. Where there are fields, the group "maps" has datasets
/// [cells along y][cells along x], averaged over the whole time, and "map_series" their course,
/// [parts][y][x]. Each dataset has its unit as the attribute "units"; NaN in gaps.
void write_hdf5(const std::filesystem::path& path, const nlohmann::ordered_json& result,
                const Measured& measured);

}  // namespace clatter
