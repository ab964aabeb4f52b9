// Functions with vector arguments or results are inlined, so their calling convention does not
// matter.
#pragma GCC diagnostic ignored "-Wpsabi"

#include "engine/dynamics/prediction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "engine/physics/contact_kernel.h"

namespace clatter {

// Whether the layout of Particle matches the rows of doubles that contact kernels read.
template <int D>
constexpr bool are_rows() {
  return sizeof(Particle<D>) == kRowLength<D> * sizeof(double) &&
         offsetof(Particle<D>, flight) == 0 && offsetof(Flight<D>, v) == D * sizeof(double) &&
         offsetof(Flight<D>, time) == 2 * D * sizeof(double) &&
         offsetof(Particle<D>, image) == (2 * D + 2) * sizeof(double) &&
         Candidates<D>::kCapacity >= CellGrid<D>::List::kCapacity;
}
static_assert(are_rows<2>() && are_rows<3>());
template <int D>
Prediction<D>::Prediction(const Model<D>& model, const Boundary<D>& boundary,
                          const LargeArray<Particle<D>>& particles, const CellGrid<D>& grid)
    : model_(model),
      boundary_(boundary),
      particles_(particles),
      grid_(grid),
      walled_(std::any_of(model.walls.begin(), model.walls.end(), [](const auto& w) { return w; })),
      planners_(model.has_gravity() ? widest_planners<true>() : widest_planners<false>()) {
  // Slightly farther than the wall moves in, so that rounding at a cell's border does not matter.
  for (int side = 0; side < 2 * D; ++side) {
    reach_[side] = 0.51 * model.diameter + boundary.innermost_travel(side);
  }
}

// Order of two periodic images through which one pair touches at the same time. The order is the
// same from either particle.
template <int D>
static bool image_before(const IntVec<D>& a, const IntVec<D>& b, bool swap) {
  const IntVec<D> u = swap ? IntVec<D>(-a) : a;
  const IntVec<D> w = swap ? IntVec<D>(-b) : b;
  return std::lexicographical_compare(u.begin(), u.end(), w.begin(), w.end());
}

template <int D>
void Prediction<D>::offer(double time, std::uint32_t particle, std::uint32_t partner,
                          const IntVec<D>& image, Plan<D>& plan) const {
  if (time > plan.time || time == kNever) return;
  if (time == plan.time) {
    const bool first =
        partner < plan.partner ||
        (partner == plan.partner && image_before<D>(image, plan.image, partner < particle));
    if (!first) return;
  }
  plan.time = time;
  plan.partner = partner;
  plan.partner_flight = partner < kWall ? particles_[partner].flight.number : 0;
  plan.image = image;
}

// Periodic image of a pair: box lengths to add to the particle's r minus the candidate's.
template <int D>
Vec<D> Prediction<D>::image_of(std::uint32_t particle, const Candidates<D>& near, int i) const {
  Vec<D> image = particles_[near.particles[i]].image - particles_[particle].image;
  if (near.wrapped) {
    for (int k = 0; k < D; ++k) image[k] -= near.wraps[k][i];
  }
  return image;
}

// Offers the contact with one candidate. If `time` is kTouching, contact_time() determines the
// time.
template <int D>
void Prediction<D>::offer_particle(std::uint32_t particle, const Candidates<D>& near, int i,
                                   double time, Plan<D>& plan) const {
  const Vec<D> image = image_of(particle, near, i);
  if (time == kTouching) {
    const Vec<D> shift = image.cwiseProduct(model_.box);
    time = contact_time<D>(particles_[particle].flight, particles_[near.particles[i]].flight, shift,
                           model_.diameter, model_.gravity);
  }
  offer(time, particle, near.particles[i], image.template cast<int>(), plan);
}

template <int D>
void Prediction<D>::weigh_each(std::uint32_t particle, const Candidates<D>& near,
                               Plan<D>& plan) const {
  for (int i = 0; i < near.size; ++i) offer_particle(particle, near, i, kTouching, plan);
}

// Separates the particle numbers of a list from their wraps.
template <int D>
static void unwrap(const typename CellGrid<D>::List& list, Candidates<D>& near) {
  for (int i = 0; i < near.size; ++i) {
    near.particles[i] = CellGrid<D>::particle_of(list.neighbours[i]);
    for (int k = 0; k < D; ++k) near.wraps[k][i] = CellGrid<D>::wrap_of(list.neighbours[i], k);
  }
}

// Copies a whole list, because its length is unpredictable.
template <int D>
[[gnu::always_inline]] static inline void take(const typename CellGrid<D>::List& list,
                                               Candidates<D>& near) {
  static_assert(sizeof near.particles >= sizeof list);
  std::memcpy(near.particles, &list, sizeof list);
  near.size = static_cast<int>(list.count);
  near.wrapped = list.wraps;
}

template <int D>
template <bool kFalling, bool kShifted, std::size_t kParticles>
std::array<FirstContact, kParticles> Prediction<D>::first_of(
    const std::array<std::uint32_t, kParticles>& particles,
    std::array<Candidates<D>, kParticles>& near) const {
  return first_contacts<D, kFalling, kShifted>(reinterpret_cast<const double*>(particles_.data()),
                                               particles, near, model_.box.data(), model_.diameter,
                                               model_.gravity.data());
}

// The fast path, which fits most events. It requires a list without continuation, a unique first
// contact, and particles without wraps. No particle may have crossed a periodic border in its
// flight. Returns false for other lists; the plans are then invalid.
template <int D>
template <bool kFalling, std::size_t kParticles>
bool Prediction<D>::look_at_plain_lists(const Requests<kParticles>& requests) const {
  std::array<std::uint32_t, kParticles> particles;
  std::array<Candidates<D>, kParticles> near;
  for (std::size_t k = 0; k < kParticles; ++k) {
    const auto& list = grid_.near(requests[k].plan->cell);
    if (list.wraps || list.next != CellGrid<D>::kNone) return false;
    particles[k] = requests[k].particle;
    take<D>(list, near[k]);
  }
  const auto first = first_of<kFalling, false>(particles, near);
  bool unique = true;
  for (std::size_t k = 0; k < kParticles; ++k) {
    Plan<D>& plan = *requests[k].plan;
    // Whether there is a contact is unpredictable. Without a contact the time is kNever, and the
    // other members have no effect.
    plan.time = first[k].time;
    plan.partner = near[k].particles[first[k].candidate];
    plan.partner_flight = particles_[plan.partner].flight.number;
    plan.image.setZero();
    unique = unique && first[k].unique;
  }
  return unique;
}

template <int D>
template <bool kFalling>
void Prediction<D>::look_at_lists(const Request& request) const {
  const auto& [particle, plan] = request;
  plan->time = kNever;
  std::array<Candidates<D>, 1> nears;
  Candidates<D>& near = nears[0];
  for (const auto* list = &grid_.near(plan->cell); list; list = grid_.next(*list)) {
    take<D>(*list, near);
    if (near.wrapped) unwrap<D>(*list, near);
    const FirstContact first = first_of<kFalling, true, 1>({particle}, nears)[0];
    if (!first.unique) {
      weigh_each(particle, near, *plan);
    } else if (first.time <= plan->time) {
      offer_particle(particle, near, first.candidate, first.time, *plan);
    }
  }
}

template <int D>
void Prediction<D>::look_at_walls(std::uint32_t particle, double now, Plan<D>& plan) const {
  for (int axis = 0; axis < D; ++axis) {
    if (model_.periodic(axis)) continue;
    for (const int side : {2 * axis, 2 * axis + 1}) {
      if (grid_.distance_from_end(axis, plan.cell[axis], side % 2) > reach_[side]) continue;
      offer(boundary_.contact_time(side, particles_[particle].flight, now), particle,
            kWall + static_cast<std::uint32_t>(side), IntVec<D>::Zero(), plan);
    }
  }
}

// A contact at the same time keeps precedence. A NaN compares as false, and std::min then returns
// its first argument.
template <int D>
void Prediction<D>::offer_border(double time, int axis, bool upper, Plan<D>& plan) const {
  const std::uint32_t border = kCellBorder + static_cast<std::uint32_t>(2 * axis + upper);
  plan.partner += (time < plan.time) * (border - plan.partner);
  plan.time = std::min(plan.time, time);
}

// A particle on a parabola may leave through the border by which it entered. The calculation starts
// at the current position: unlike a contact time, a crossing time need not be a function of the
// stored state alone.
template <int D>
void Prediction<D>::look_at_border_falling(std::uint32_t particle, double now, int axis,
                                           Plan<D>& plan) const {
  const Particle<D>& self = particles_[particle];
  const double a = model_.gravity[axis];
  const double since = now - self.flight.time;
  const double r = self.flight.r[axis] + (self.flight.v[axis] + a * (0.5 * since)) * since -
                   self.image[axis] * model_.box[axis];
  const double v = self.flight.v[axis] + a * since;
  const double lower = grid_.border(axis, plan.cell[axis], false);
  const double upper = grid_.border(axis, plan.cell[axis], true);
  const WayOut out = exit_time(r - lower, upper - r, v, a);
  double time = now + out.time;
  // A particle that turns just beyond a border returns later, at least by the smallest time step.
  if (time == now && (v < 0.0) == out.upper) [[unlikely]]
    time = std::nextafter(now, kNever);
  offer_border(time, axis, out.upper, plan);
}

// Branch-free, because the signs of the velocity and the first event are unpredictable.
template <int D>
template <bool kFalling>
void Prediction<D>::look_at_borders(std::uint32_t particle, double now, Plan<D>& plan) const {
  const Particle<D>& self = particles_[particle];
  std::array<bool, D> upper;
  Vec<D> place;
  for (int axis = 0; axis < D; ++axis) {
    upper[axis] = self.flight.v[axis] >= 0.0;
    place[axis] = grid_.border(axis, plan.cell[axis], upper[axis]);
  }
  const Vec<D> way = place + self.image.cwiseProduct(model_.box) - self.flight.r;
  // v + 0.0 turns -0 into +0: a particle at rest reaches its upper border at time infinity.
  const Vec<D> time = self.flight.time + way.array() / (self.flight.v.array() + 0.0);
  for (int axis = 0; axis < D; ++axis) {
    if (kFalling && model_.gravity[axis] != 0.0) {
      look_at_border_falling(particle, now, axis, plan);
    } else {
      offer_border(std::max(now, time[axis]), axis, upper[axis], plan);
    }
  }
}

template <int D>
template <bool kFalling, bool kPlain, std::size_t kParticles>
void Prediction<D>::make_plans(const Requests<kParticles>& requests, double now) const {
  if constexpr (kPlain) {
    if (!look_at_plain_lists<kFalling>(requests)) [[unlikely]] {
      for (const Request& request : requests) planners_.any(*this, {request}, now);
      return;
    }
  } else {
    for (const Request& request : requests) look_at_lists<kFalling>(request);
  }
  for (const auto& [particle, plan] : requests) look_at_borders<kFalling>(particle, now, *plan);
  if (!walled_) return;
  for (const auto& [particle, plan] : requests) look_at_walls(particle, now, *plan);
}

template <int D>
template <bool kFalling, bool kPlain, std::size_t kParticles>
void Prediction<D>::plan_baseline(const Prediction& prediction,
                                  const Requests<kParticles>& requests, double now) {
  prediction.make_plans<kFalling, kPlain>(requests, now);
}

#if defined(__x86_64__)
template <int D>
template <bool kFalling, bool kPlain, std::size_t kParticles>
void Prediction<D>::plan_avx2(const Prediction& prediction, const Requests<kParticles>& requests,
                              double now) {
  prediction.make_plans<kFalling, kPlain>(requests, now);
}
#endif

template <int D>
template <bool kFalling>
typename Prediction<D>::Planners Prediction<D>::widest_planners() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    return {plan_avx2<kFalling, true, 1>, plan_avx2<kFalling, true, 2>,
            plan_avx2<kFalling, false, 1>};
  }
#endif
  return {plan_baseline<kFalling, true, 1>, plan_baseline<kFalling, true, 2>,
          plan_baseline<kFalling, false, 1>};
}

template class Prediction<2>;
template class Prediction<3>;

}  // namespace clatter
