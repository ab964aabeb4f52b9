#pragma once

#include <filesystem>

#include "app/results/particle_frame.h"

namespace clatter {

/// Sorts the particles of a frame into species, by their types, diameters and masses. Lengths are
/// in units of the scene. Particles that are alike have no species, unless the file says so; they
/// have the diameter 1. Without types, particles of equal diameter and mass are a species. Without
/// diameters these are 1, and without masses these are those of the density 1. Unequal diameters of
/// a species are a polydispersity. Throws UserError for numbers that are not positive, and for
/// species that a scene cannot have. `scale` is the unit of length, for advice.
void sort_into_species(ParticleFrame& frame, double scale, const std::filesystem::path& path);

/// The species as tables of a scene, without their numbers of particles.
std::string species_toml(const ParticleFrame& frame);

}  // namespace clatter
