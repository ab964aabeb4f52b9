#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "app/results/particle_frame.h"
#include "app/results/trajectory.h"

namespace clatter {

/// Reads a frame of a trajectory; absent: the last. A start state in CSV is a trajectory of one
/// frame. Particles are inside the box along periodic axes. In formats for three dimensions a frame
/// with all positions and velocities at z = 0 has disks. Throws UserError with the place for a
/// malformed file, for a missing frame, and for particles whose diameter is not 1.
ParticleFrame read_frame(const std::filesystem::path& path, TrajectoryFormat format,
                         std::optional<std::size_t> frame);

/// Moves particles into the box along periodic axes, if the frame has a box. Throws UserError with
/// the file of the frame if a periodic image is no whole number of 32 bits.
void wrap_into_box(ParticleFrame& frame, const std::filesystem::path& path);

}  // namespace clatter
