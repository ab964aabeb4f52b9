#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "engine/measure/measurement.h"

namespace clatter {

/// Writes a measurement as an HDF5 file with the names of the result file. Objects are groups;
/// numbers, texts and lists are attributes. The group "scene" thus has the complete scene. `series`
/// and `profile` are datasets. With fields, the group "maps" has datasets [cells along y][cells
/// along x], averages over the whole time. The group "map_series" has datasets [parts][y][x],
/// averages over parts of the time. The attribute "units" of a dataset has its unit. Cells without
/// data have NaN. Throws Interrupted.
void write_hdf5(const std::filesystem::path& path, const nlohmann::ordered_json& result,
                const Measured& measured, const StopRequest& stop = {});

}  // namespace clatter
