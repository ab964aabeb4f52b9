#include "engine/initial/adapt_to_scene.h"

#include <cmath>

#include "engine/initial/random_insertion.h"
#include "engine/initial/start_state.h"
#include "engine/physics/state.h"

namespace clatter {

template <int D>
State<D> adapt_to_scene(const State<D>& state, const Scene& scene, std::uint64_t seed) {
  // RandomInsertion places particles of one diameter only.
  if (!scene.species.empty() || !state.grains.empty()) return start_state<D>(scene, seed);
  const Vec<D> corner = scene.clear_corner();
  const auto count = static_cast<std::size_t>(scene.particles.count);
  Random random(seed, Stream::Placement, 1, 0);
  RandomInsertion<D> insertion(scene.start_room<D>(), scene.particles.count, random);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < state.positions.size() && kept.size() < count; ++i) {
    if (insertion.place_first(state.positions[i] - corner)) kept.push_back(i);
  }
  insertion.advance();
  State<D> fitted;
  fitted.positions = insertion.take();
  if (fitted.positions.empty()) return start_state<D>(scene, seed);

  const double speed = std::sqrt(temperature_of(state));
  for (std::size_t i = 0; i < fitted.positions.size(); ++i) {
    fitted.positions[i] += corner;
    if (i < kept.size()) {
      fitted.velocities.push_back(state.velocities[kept[i]]);
    } else {
      Random random_velocity(seed, Stream::Velocity, static_cast<std::uint32_t>(i), 1);
      Vec<D>& velocity = fitted.velocities.emplace_back();
      for (double& component : velocity) component = speed * random_velocity.normal();
    }
    if (!scene.spins()) continue;
    const bool spun = i < kept.size() && !state.spins.empty();
    fitted.spins.push_back(spun ? state.spins[kept[i]] : Spin<D>::Zero());
  }
  return fitted;
}

template State<2> adapt_to_scene(const State<2>&, const Scene&, std::uint64_t);
template State<3> adapt_to_scene(const State<3>&, const Scene&, std::uint64_t);

}  // namespace clatter
