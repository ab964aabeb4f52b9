#include "engine/publish/encounter.h"

#include "engine/error.h"

namespace clatter {

void EncounterWatch::on_collision(const PairCollision<2>& collision) {
  const std::uint32_t first = collision.disks[0].disk, second = collision.disks[1].disk;
  if (first != disk_ && second != disk_) return;
  last_ = {simulation_.time(), first == disk_ ? second : first, 0};
}

void EncounterWatch::on_wall(const WallCollision<2>& collision) {
  if (collision.disk.disk == disk_) last_ = {simulation_.time(), std::nullopt, collision.side};
}

std::optional<Encounter> next_encounter(const Simulation<2>& simulation, std::uint32_t disk) {
  // Most disks collide while all the others do so a few times.
  const std::uint64_t most = 100 * (simulation.disks().size() + 100);
  Simulation<2> ahead(simulation.model(), simulation.save());
  EncounterWatch watch(ahead, disk);
  ahead.add_observer(watch);
  const EventCounts& counts = ahead.counts();
  const std::uint64_t last_step = counts.steps() + most;
  try {
    // It arrives at the end of time where nothing is to happen any more.
    while (!watch.last() && counts.steps() < last_step &&
           !ahead.run_until(kNever, counts.collisions() + 1, last_step)) {
    }
  } catch (const PhysicalStop&) {
    // Time stands still before: there is no next one.
  }
  return watch.last();
}

}  // namespace clatter
