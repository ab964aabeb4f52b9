#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/dynamics/run_state.h"

namespace clatter {

/// A saved run, from which it can be resumed.
struct Checkpoint {
  std::string program;             ///< program that wrote it, with its version
  std::string command;             ///< command of the program, such as "measure"
  std::string scene;               ///< the whole scene as TOML, every default written out
  double start_temperature = 0.0;  ///< T at time 0; a scene with a start file does not contain it
  std::uint64_t seed = 1;          ///< of the run
  AnyRunState saved;               ///< the run itself
  std::string measurement;         ///< result of Measurement::save(); empty: no measurement
  std::string film;                ///< state of a film, or of a view; empty: none
  std::string trajectory;          ///< state of a trajectory; empty: no trajectory
  std::string events;              ///< state of an event log; empty: no log
};

/// The content of a checkpoint file.
std::string checkpoint_bytes(Checkpoint& checkpoint);

/// The checkpoint with this content. Throws UserError, with `file` as its name, if the content is
/// damaged or of another version; the last error names the program that wrote it.
Checkpoint checkpoint_of(std::string_view bytes, const std::filesystem::path& file);

/// Writes a checkpoint. A whole checkpoint exists at every moment, even if the machine stops. The
/// new file gets its name only after it is on the disk, and the previous one becomes FILE.previous.
/// Throws RunError.
void write_checkpoint(const std::filesystem::path& file, Checkpoint& checkpoint);

/// Reads a checkpoint. Throws UserError if the file is missing, and as checkpoint_of() does.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// Name of the previous checkpoint.
std::filesystem::path previous_checkpoint(const std::filesystem::path& file);

/// Whether a file begins with the magic of checkpoints.
bool is_checkpoint(const std::filesystem::path& file);

}  // namespace clatter
