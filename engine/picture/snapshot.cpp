#include "engine/picture/snapshot.h"

#include <cmath>
#include <utility>

#include "engine/dynamics/simulation.h"

namespace clatter {

template <int D>
Snapshot snapshot_of(const Simulation<D>& simulation) {
  State<D> state = simulation.state();
  Snapshot snapshot;
  snapshot.time = simulation.time();
  snapshot.box = simulation.model().box;
  snapshot.diameter = simulation.model().diameter;
  for (int side = 0; side < 2 * D; ++side) {
    snapshot.walls[side] = simulation.model().walls[side];
    snapshot.wall_displacement[side] = simulation.wall(side).displacement;
  }
  snapshot.piston_travel = simulation.piston_travel();
  if (state.piston) snapshot.free_piston = state.piston->place;
  snapshot.positions = as_columns(state.positions);
  if (const Domain<D> domain = simulation.domain(); domain.sheared) {
    snapshot.slide = domain.slide;
    snapshot.offset = domain.offset - std::floor(domain.offset / domain.box[0]) * domain.box[0];
    add_flow(state, domain, -1.0);
  }
  snapshot.velocities = as_columns(state.velocities);
  snapshot.grains = std::move(state.grains);
  if (simulation.model().spins) snapshot.spins = as_columns(state.spins);
  snapshot.temperature = simulation.temperature();
  snapshot.collisions = simulation.counts().pair_collisions;
  return snapshot;
}

template Snapshot snapshot_of(const Simulation<2>&);
template Snapshot snapshot_of(const Simulation<3>&);

}  // namespace clatter
