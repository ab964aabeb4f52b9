#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/stop_request.h"
#include "engine/vec.h"

namespace clatter {

/// Gaussian velocities of particles of mass 1, with exactly the temperature, and with mean 0 for
/// two or more particles. They depend on the number of particles and the seed alone. Throws
/// Interrupted.
template <int D>
std::vector<Vec<D>> gaussian_velocities(std::size_t count, double temperature, std::uint64_t seed,
                                        const StopRequest& stop = {});

/// The same of particles of these masses: of variance T/m, with total momentum 0.
template <int D>
std::vector<Vec<D>> gaussian_velocities(const std::vector<double>& masses, double temperature,
                                        std::uint64_t seed, const StopRequest& stop = {});

}  // namespace clatter
