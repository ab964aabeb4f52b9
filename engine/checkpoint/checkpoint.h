#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/dynamics/run_state.h"

namespace clatter {

/// A run put aside in a file, from which it can go on.
struct Checkpoint {
  std::string program;             ///< that wrote it, with its version
  std::string command;             ///< of that program: "measure"
  std::string scene;               ///< the whole scene as TOML, every default written out
  double start_temperature = 0.0;  ///< T at time 0, which the scene lacks where a file has it
  std::uint64_t seed = 1;          ///< of the run
  AnyRunState saved;               ///< the run itself
  std::string measurement;         ///< what Measurement::save() gave; empty: nothing was measured
  std::string film;                ///< how far a film has come; empty: none was made
};

/// Writes a checkpoint, so that at any moment, also if the machine stops, there is a whole one: it
/// gets its name once it is on the disk, and the one before then is called FILE.previous. Throws
/// RunError.
void write_checkpoint(const std::filesystem::path& file, Checkpoint& checkpoint);

/// Reads a checkpoint; throws UserError where there is none, or one that is damaged or of another
/// version, and then says which program wrote it.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// What the one before is called.
std::filesystem::path previous_checkpoint(const std::filesystem::path& file);

/// Whether a file begins as checkpoints do.
bool is_checkpoint(const std::filesystem::path& file);

}  // namespace clatter
