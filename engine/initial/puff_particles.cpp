#include "engine/initial/puff_particles.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/clock.h"
#include "engine/error.h"
#include "engine/initial/free_room.h"
#include "engine/laws/limits.h"
#include "engine/laws/model.h"
#include "engine/physics/random.h"

namespace clatter {

namespace {

// The box and its images at the time of a state.
template <int D>
Domain<D> domain_at(const Model<D>& model, const RunState<D>& state) {
  const Boundary<D> boundary(model, Clock(state.base), {}, {}, state.shear_phase);
  return boundary.domain().at(state.now);
}

// The room between the particles of a gas at one time, the walls at that time, and the fixtures.
template <int D>
FreeRoom<D> room_between(const Model<D>& model, const Scene& laws, const RunState<D>& state) {
  const Vec<D> low = laws.clear_corner();
  Vec<D> high = low + Vec<D>(laws.clear_box());
  if (state.piston) high[0] -= state.piston->travel(Clock(state.base).absolute(state.now));
  FreeRoom<D> room(domain_at(model, state), model.diameter, low, high, model.fixtures);
  for (std::size_t i = 0; i < state.flights.size(); ++i) {
    room.insert(state.flights[i].at(state.now, state.gravity),
                state.grains.empty() ? 0.5 * model.diameter : state.grains[i].radius);
  }
  return room;
}

// A point in a ball around the origin, with equal probability everywhere.
template <int D>
Vec<D> point_in_ball(double radius, Random& random) {
  Vec<D> point;
  do {
    for (double& component : point) component = 2.0 * random.uniform() - 1.0;
  } while (point.squaredNorm() > 1.0);
  return radius * point;
}

}  // namespace

template <int D>
std::vector<PuffParticle<D>> puff_particles(const RunState<D>& state, const Puff& puff,
                                            const Scene& laws, std::uint64_t seed) {
  constexpr int kTries = 10'000;  // of a particle in succession
  const Model<D> model = model_of<D>(laws, seed);
  const std::size_t before = state.flights.size();
  FreeRoom<D> room = room_between(model, laws, state);
  const Domain<D> domain = domain_at(model, state);
  Random random(seed, Stream::Puff, static_cast<std::uint32_t>(state.counts.puffs), 0);
  const Vec<D> centre = puff.centre;
  const Vec<D> mean = puff.velocity ? Vec<D>(*puff.velocity) : Vec<D>(Vec<D>::Zero());
  const std::size_t species = find_species(laws.species, puff.species).value_or(0);
  const auto is_in_piston = [&](const Vec<D>& point, double radius) {
    if (!state.free_piston) return false;
    const FreePiston& piston = *model.free_piston;
    const double way = point[piston.axis] - state.free_piston->at(state.now);
    return std::fabs(way) < 0.5 * piston.thickness + radius;
  };
  std::vector<PuffParticle<D>> particles;
  for (int tries = 0; tries < kTries && static_cast<int>(particles.size()) < puff.count; ++tries) {
    const Vec<D> point = domain.wrapped(centre + point_in_ball<D>(puff.radius, random));
    const auto number = static_cast<int>(particles.size());
    const Grain grain =
        laws.species.empty() ? model.grain() : laws.grain(species, number, puff.count);
    if (is_in_piston(point, grain.radius)) continue;
    if (!room.insert_if_free(point, grain.radius, grain.species)) continue;
    tries = 0;
    Vec<D> velocity = mean;
    const double spread = std::sqrt(puff.temperature / grain.mass);
    for (double& component : velocity) component += spread * random.normal();
    if (!(velocity.norm() <= kMaxSpeed)) {
      throw PhysicalStop(
          fmt::format("a puff gives particle {} a speed above {:.0e}; make it colder",
                      before + particles.size(), kMaxSpeed));
    }
    particles.push_back({point, velocity, grain});
  }
  return particles;
}

template std::vector<PuffParticle<2>> puff_particles(const RunState<2>&, const Puff&, const Scene&,
                                                     std::uint64_t);
template std::vector<PuffParticle<3>> puff_particles(const RunState<3>&, const Puff&, const Scene&,
                                                     std::uint64_t);

}  // namespace clatter
