#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace clatter {

/// The options of `clatter convert`.
struct ConvertOptions {
  std::string in;                    ///< trajectory, start state or checkpoint
  std::string out;                   ///< start state (.csv) or trajectory of one frame
  std::optional<std::size_t> frame;  ///< of a trajectory, from 0; absent: the last
  std::string scene;                 ///< scene whose box the particles of a CSV have; empty: none
};

/// Writes a frame or the state of a checkpoint in another format. Returns the exit code. Throws
/// UserError and RunError.
int convert(const ConvertOptions& options);

}  // namespace clatter
