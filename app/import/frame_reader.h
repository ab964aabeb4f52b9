#pragma once

#include <filesystem>

#include "app/results/particle_frame.h"

namespace clatter {

/// Whether a file is text that is not compressed. Throws UserError if its name is of no format, or
/// of a device or a pipe.
bool is_plain_text(const std::filesystem::path& path);

/// Reads a frame of a trajectory, a start state in CSV, or a data file of LAMMPS. The extension
/// names the format, before a name data.NAME does; text formats may be compressed by gzip. A start
/// state is a trajectory of one frame. Lengths are divided by the chosen scale. Particles are
/// inside the box along periodic axes. Throws UserError with the place for a malformed file, for a
/// missing frame, and for particles that no scene can have. `flag` names the file in errors of its
/// extension.
ParticleFrame read_frame(const std::filesystem::path& path, const FrameChoice& choice,
                         const char* flag);

/// Moves particles into the box along periodic axes, if the frame has a box. Periodic images along
/// other axes mean nothing and become 0. Throws UserError with the file of the frame if a periodic
/// image is no whole number of 32 bits.
void wrap_into_box(ParticleFrame& frame, const std::filesystem::path& path);

}  // namespace clatter
