#include "engine/initial/adapt_to_scene.h"

#include <cmath>

#include "engine/initial/random_insertion.h"
#include "engine/initial/start_state.h"
#include "engine/physics/temperature.h"

namespace clatter {

State<2> adapt_to_scene(const State<2>& state, const Scene& scene, std::uint64_t seed) {
  const Vec2 corner = scene.clear_corner();
  std::vector<Vec2> wanted = state.positions;
  for (Vec2& position : wanted) position -= corner;
  std::vector<std::size_t> kept;
  Random random(seed, Stream::Placement, 1, 0);
  State<2> fitted;
  fitted.positions =
      random_insertion(scene.start_room(), scene.particles.count, random, wanted, kept);
  if (fitted.positions.empty()) return start_state(scene, seed);

  const double speed = std::sqrt(temperature_of(state));
  for (std::size_t i = 0; i < fitted.positions.size(); ++i) {
    fitted.positions[i] += corner;
    Random of_particle(seed, Stream::Velocity, static_cast<std::uint32_t>(i), 1);
    const double x = of_particle.normal();
    fitted.velocities.push_back(i < kept.size() ? state.velocities[kept[i]]
                                                : Vec2(speed * x, speed * of_particle.normal()));
    if (!scene.spins()) continue;
    const bool spun = i < kept.size() && !state.spins.empty();
    fitted.spins.push_back(spun ? state.spins[kept[i]] : Spin<2>::Zero());
  }
  return fitted;
}

}  // namespace clatter
