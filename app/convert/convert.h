#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/results/particle_frame.h"

namespace clatter {

/// The options of `clatter convert`.
struct ConvertOptions {
  std::string in;      ///< trajectory, start state, data file of LAMMPS or checkpoint
  std::string out;     ///< start state (.csv) or trajectory of one frame
  FrameChoice choice;  ///< of the particles of a file
  std::optional<double> temperature;  ///< of velocities that are drawn; absent: those of the file
  std::uint64_t seed = 1;             ///< of these velocities
  std::string scene;  ///< whose box the particles of a file without one have; empty: none
};

/// Writes a frame or the state of a checkpoint in another format. Returns the exit code. Throws
/// UserError and RunError.
int convert(const ConvertOptions& options);

}  // namespace clatter
