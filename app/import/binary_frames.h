#pragma once

#include <filesystem>

#include "app/results/particle_frame.h"

namespace clatter {

// Readers of binary formats, for read_frame. They throw UserError with the file for a malformed
// file.

/// A frame of GSD: https://gsd.readthedocs.io/en/stable/schema-hoomd.html.
ParticleFrame read_gsd_frame(const std::filesystem::path& path, const FrameChoice& choice);
/// A frame of H5MD: https://www.nongnu.org/h5md/h5md.html.
ParticleFrame read_h5md_frame(const std::filesystem::path& path, const FrameChoice& choice);
/// The only frame of a file of VTK PolyData, see VtkFile. Its points are the particles.
ParticleFrame read_vtp_frame(const std::filesystem::path& path, const FrameChoice& choice);
/// A frame of a list of such files, .vtp.series or .pvd. The files are beside the list.
ParticleFrame read_vtp_series(const std::filesystem::path& path, const FrameChoice& choice);

}  // namespace clatter
