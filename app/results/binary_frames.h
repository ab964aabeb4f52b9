#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "app/results/particle_frame.h"

namespace clatter {

// Readers of binary formats, for read_frame. The frame is the last if its number is absent. They
// throw UserError with the file for a malformed file.

/// A frame of GSD.
ParticleFrame read_gsd_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted);
/// A frame of H5MD.
ParticleFrame read_h5md_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted);

}  // namespace clatter
