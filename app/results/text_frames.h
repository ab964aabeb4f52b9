#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "app/results/particle_frame.h"

namespace clatter {

// Readers of text formats, for read_frame. The frame is the last if its number is absent. They
// throw UserError with file and line for a malformed file.

/// A frame of a trajectory or of a start state in CSV.
ParticleFrame read_csv_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted);
/// A frame of extended XYZ.
ParticleFrame read_xyz_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted);
/// A frame of a text dump of LAMMPS.
ParticleFrame read_dump_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted);

}  // namespace clatter
