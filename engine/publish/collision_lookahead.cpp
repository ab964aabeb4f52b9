#include "engine/publish/collision_lookahead.h"

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

Scout::Scout(const Simulation<2>& simulation, std::uint32_t disk)
    : ahead_(simulation.model(), simulation.save()), disk_(disk), watch_(ahead_, disk) {
  ahead_.add_observer(watch_);
}

const std::optional<Encounter>& Scout::next_after(double time, std::uint64_t most_steps) {
  const EventCounts& counts = ahead_.counts();
  const std::uint64_t last_step = counts.steps() + most_steps;
  const auto passed = [&] { return watch_.last() && watch_.last()->time <= time; };
  if (passed()) watch_.watch(disk_);
  try {
    while (!ended_ && !watch_.last() && counts.steps() < last_step) {
      // It arrives at the end of time where nothing is to happen any more.
      ended_ = ahead_.run_until(kNever, counts.collisions() + 1, last_step);
      if (passed()) watch_.watch(disk_);
    }
  } catch (const PhysicalStop&) {
    ended_ = true;
  }
  return watch_.last();
}

}  // namespace clatter
