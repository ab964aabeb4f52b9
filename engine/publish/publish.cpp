#include "engine/publish/publish.h"

#include <utility>

namespace clatter {

Snapshot snapshot_of(const Simulation<2>& simulation) {
  State<2> state = simulation.state();
  Snapshot snapshot;
  snapshot.time = simulation.time();
  snapshot.box = simulation.model().box;
  snapshot.diameter = simulation.model().diameter;
  snapshot.walls = simulation.model().walls;
  for (int side = 0; side < 4; ++side) {
    snapshot.wall_displacement[side] = simulation.wall(side).displacement;
  }
  snapshot.positions = std::move(state.positions);
  snapshot.velocities = std::move(state.velocities);
  for (const Spin<2>& spin : state.spins) snapshot.spins.push_back(spin[0]);
  const auto count = static_cast<double>(snapshot.positions.size());
  snapshot.temperature = count > 0.0 ? simulation.kinetic_energy() / count : 0.0;
  snapshot.collisions = simulation.counts().pair_collisions;
  return snapshot;
}

}  // namespace clatter
