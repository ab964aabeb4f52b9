#pragma once

#include <filesystem>

#include "app/results/particle_frame.h"

namespace clatter {

// Readers of text formats, for read_frame. They throw UserError with file and line for a malformed
// file.

/// A frame of a trajectory or of a start state in CSV.
ParticleFrame read_csv_frame(const std::filesystem::path& path, const FrameChoice& choice);
/// A frame of extended XYZ: https://github.com/libAtoms/extxyz.
ParticleFrame read_xyz_frame(const std::filesystem::path& path, const FrameChoice& choice);
/// A frame of a text dump of LAMMPS: https://docs.lammps.org/dump.html.
ParticleFrame read_dump_frame(const std::filesystem::path& path, const FrameChoice& choice);
/// The particles of a data file of LAMMPS: https://docs.lammps.org/read_data.html.
ParticleFrame read_data_file(const std::filesystem::path& path, const FrameChoice& choice);

/// The chosen frame of a trajectory. `frames.next()` is its next frame, absent at the end.
template <class Frames>
ParticleFrame chosen_frame(Frames frames, const std::filesystem::path& path,
                           const FrameChoice& choice) {
  std::optional<ParticleFrame> last;
  for (std::size_t number = 0;; ++number) {
    std::optional<ParticleFrame> frame = frames.next();
    if (!frame && (choice.frame || !last)) refuse_frame(path, number);
    if (!frame) return *last;
    if (choice.frame == number) return *frame;
    last = std::move(frame);
  }
}

}  // namespace clatter
