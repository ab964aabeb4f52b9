#include "engine/initial/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/dimension.h"
#include "engine/dynamics/event.h"
#include "engine/dynamics/neighbourhood.h"
#include "engine/dynamics/particle.h"
#include "engine/dynamics/prediction.h"
#include "engine/error.h"
#include "engine/physics/spin.h"
#include "engine/physics/state.h"
#include "engine/scene/act_checks.h"
#include "engine/system/allocation.h"

namespace clatter {

// Bytes of a particle, its plan, its share of the lists of cells, and two entries of the event
// queue with room to grow. In clusters there may be up to four cells per particle and continued
// lists (CellGrid::fit), which are not counted. Lists of dense spheres take as much as those of
// cells.
template <int D>
static constexpr double kBytesPerParticle =
    sizeof(Particle<D>) +
    sizeof(Plan<D>) + CellGrid<D>::kCellsPerParticle * sizeof(typename CellGrid<D>::List) +
    4 * sizeof(Event);

template <int D>
static GasMemory memory_of(const Scene& scene) {
  const auto count = static_cast<double>(final_count(scene));
  const double remainder = scene.box.maxCoeff() > kLongBox ? sizeof(Vec<D>) : 0.0;
  // Particles of few kinds have a byte each, see GrainArray.
  const bool many_kinds =
      std::ranges::any_of(scene.species, [](const Species& one) { return !!one.polydispersity; });
  const double kind = scene.species.empty() ? 0.0 : 1.0;
  const double grain = many_kinds ? sizeof(Grain) + sizeof(double) : kind;
  return {count * (kBytesPerParticle<D> + remainder + grain),
          scene.spins() ? count * sizeof(Spin<D>) : 0.0,
          scene.contact_time ? count * sizeof(double) : 0.0};
}

GasMemory gas_memory(const Scene& scene) {
  return with_dimension(scene.dimension(),
                        [&](auto dimension) { return memory_of<dimension>(scene); });
}

static int most_particles(const Scene& scene) {
  return static_cast<int>(scene.dimension() == 2 ? kMaxParticles<2> : kMaxParticles<3>);
}

void require_memory(const Scene& scene) {
  const double there = available_memory();
  const double needed = gas_memory(scene).total();
  const std::int64_t count = final_count(scene);
  if (needed <= there && count <= most_particles(scene)) return;
  const double fitting = std::floor(static_cast<double>(count) * (there / needed));
  const auto gigabytes = [](double bytes) { return fmt::format("{:.3g} GB", 1e-9 * bytes); };
  const std::string reason = needed <= there ? " particles exceed the limit of the program"
                                             : " particles take about " + gigabytes(needed) +
                                                   ", and this process may use " + gigabytes(there);
  throw UserError(
      {scene.species.empty() ? "particles.count" : "species", 0, 0}, std::to_string(count) + reason,
      "choose at most " +
          std::to_string(static_cast<int>(std::min<double>(most_particles(scene), fitting))));
}

}  // namespace clatter
