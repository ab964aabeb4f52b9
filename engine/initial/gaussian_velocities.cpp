#include "engine/initial/gaussian_velocities.h"

#include <cmath>

#include "engine/physics/random.h"

namespace clatter {

template <int D>
std::vector<Vec<D>> gaussian_velocities(std::size_t count, double temperature, std::uint64_t seed,
                                        const StopRequest& stop) {
  std::vector<Vec<D>> velocities(count);
  Vec<D> mean = Vec<D>::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    stop.check();
    Random random(seed, Stream::Velocity, static_cast<std::uint32_t>(i), 0);
    for (double& component : velocities[i]) component = random.normal();
    mean += velocities[i] / static_cast<double>(count);
  }
  double twice_energy = 0.0;
  for (Vec<D>& v : velocities) {
    if (count >= 2) v -= mean;
    twice_energy += v.squaredNorm();
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

}  // namespace clatter
