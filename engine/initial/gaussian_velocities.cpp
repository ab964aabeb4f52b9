#include "engine/initial/gaussian_velocities.h"

#include <cmath>
#include <numeric>

#include "engine/physics/random.h"

namespace clatter {

template <int D>
std::vector<Vec<D>> gaussian_velocities(std::size_t count, double temperature, std::uint64_t seed,
                                        const StopRequest& stop) {
  return gaussian_velocities<D>(std::vector<double>(count, 1.0), temperature, seed, stop);
}

template <int D>
std::vector<Vec<D>> gaussian_velocities(const std::vector<double>& masses, double temperature,
                                        std::uint64_t seed, const StopRequest& stop) {
  const std::size_t count = masses.size();
  const double mass = std::accumulate(masses.begin(), masses.end(), 0.0);
  std::vector<Vec<D>> velocities(count);
  Vec<D> mean = Vec<D>::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    stop.check();
    Random random(seed, Stream::Velocity, static_cast<std::uint32_t>(i), 0);
    for (double& component : velocities[i]) component = random.normal() / std::sqrt(masses[i]);
    mean += velocities[i] / (mass / masses[i]);
  }
  double twice_energy = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (count >= 2) velocities[i] -= mean;
    twice_energy += masses[i] * velocities[i].squaredNorm();
  }
  const double freedoms = static_cast<double>(D) * static_cast<double>(count);
  const double scale = std::sqrt(freedoms * temperature / twice_energy);
  for (Vec<D>& v : velocities) v = temperature > 0.0 ? Vec<D>(v * scale) : Vec<D>::Zero();
  return velocities;
}

template std::vector<Vec<2>> gaussian_velocities<2>(std::size_t, double, std::uint64_t,
                                                    const StopRequest&);
template std::vector<Vec<3>> gaussian_velocities<3>(std::size_t, double, std::uint64_t,
                                                    const StopRequest&);

template std::vector<Vec<2>> gaussian_velocities<2>(const std::vector<double>&, double,
                                                    std::uint64_t, const StopRequest&);
template std::vector<Vec<3>> gaussian_velocities<3>(const std::vector<double>&, double,
                                                    std::uint64_t, const StopRequest&);

}  // namespace clatter
