#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/results/particle_frame.h"

namespace clatter {

/// Sorts the particles of a binary file by their identifiers, and removes places without one.
/// Throws UserError for identifiers that occur twice.
void sort_by_id(ParticleFrame& frame, const std::vector<std::optional<double>>& ids,
                const std::filesystem::path& path);

}  // namespace clatter
