#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/laws/fixture.h"
#include "engine/measure/measurement.h"

namespace clatter {

/// Writes the maps of a measurement into a folder, as VTK ImageData with cell data. The file
/// fields.vti has the averages over the whole time, and the residuals. The file series.pvd lists
/// series_00.vti, ..., the averages over parts of the time. Velocity and heat flux are vectors,
/// stress is a symmetric tensor, and cells without data have NaN. Every file contains `origin`,
/// which must not contain "--". Omits absent fields. Removes the remaining parts of an earlier
/// series. Throws Interrupted between fields.
void write_vtk(const std::filesystem::path& folder, const Measured& measured,
               const std::string& origin, const StopRequest& stop = {});

/// Writes the shapes of fixtures into the same folder, as fixtures.vtp. Without any it removes this
/// file.
template <int D>
void write_vtk_fixtures(const std::filesystem::path& folder,
                        const std::vector<Fixture<D>>& fixtures, const std::string& origin);

/// The names of all files of such a folder.
std::vector<std::string> vtk_names();

}  // namespace clatter
