#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/measure/measurement.h"

namespace clatter {

/// Writes the maps of a measurement as VTK ImageData with cell data into a folder: fields.vti, the
/// averages over the whole time, and residuals; series.pvd, the averages' course, and
/// series_00.vti,
/// ..., which it lists. Velocity and heat flux are vectors, stress is a symmetric tensor; NaN in
/// gaps. `origin` says in every file what made it; no "--" in it. Writes nothing of what there is
/// not, and removes the parts of an earlier series in the folder that this one does not replace.
void write_vtk(const std::filesystem::path& folder, const Measured& measured,
               const std::string& origin);

/// The names of all files that it may write.
std::vector<std::string> vtk_names();

}  // namespace clatter
