// Functions with vector arguments or results are inlined, so their calling convention does not
// matter.
#pragma GCC diagnostic ignored "-Wpsabi"

#include "engine/dynamics/prediction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "engine/dynamics/contact_kernel.h"

namespace clatter {

// Whether the layout of Particle matches the rows of doubles that contact kernels read.
template <int D>
constexpr bool are_rows() {
  return sizeof(Particle<D>) == kRowLength * sizeof(double) && offsetof(Particle<D>, flight) == 0 &&
         offsetof(Flight<D>, v) == D * sizeof(double) &&
         offsetof(Flight<D>, time) == 2 * D * sizeof(double) &&
         offsetof(Particle<D>, image) == (2 * D + 1) * sizeof(double) + sizeof(std::uint32_t);
}
static_assert(are_rows<2>() && are_rows<3>());

template <int D>
Prediction<D>::Prediction(const Model<D>& model, const Boundary<D>& boundary,
                          const ParticleArray<D>& particles, const GrainArray& grains,
                          const Neighbourhood<D>& near)
    : model_(model),
      boundary_(boundary),
      particles_(particles),
      grains_(grains),
      near_(near),
      walled_(!model.is_periodic() || !model.fixtures.empty()) {
  set_laws();
}

template <int D>
void Prediction<D>::set_laws() {
  if (grains_.empty()) {
    planners_ =
        model_.has_gravity() ? widest_planners<true, false>() : widest_planners<false, false>();
  } else {
    planners_ =
        model_.has_gravity() ? widest_planners<true, true>() : widest_planners<false, true>();
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
    const auto number = [this](std::uint32_t p) {
      return numbers_ && p < kPiece ? numbers_[p] : p;
    };
    const bool swap = number(partner) < number(particle);
    const bool first = number(partner) < number(plan.partner) ||
                       (partner == plan.partner && image_before<D>(image, plan.image, swap));
    if (!first) return;
  }
  plan.time = time;
  plan.partner = partner;
  plan.partner_flight = partner < kPiece ? particles_[partner].flight.number : 0;
  plan.image = image;
}

// Periodic image of a pair: box lengths to add to the particle's r minus the candidate's.
template <int D>
Vec<D> Prediction<D>::image_of(std::uint32_t particle, const Candidates<D>& near, int i) const {
  const Neighbour neighbour = near.neighbours[i];
  Vec<D> image = particles_.image(particle_of<D>(neighbour)) - particles_.image(particle);
  for (int k = 0; k < D; ++k) image[k] -= wrap_of<D>(neighbour, k);
  image[0] += near_.boxes_slid() * wrap_of<D>(neighbour, 1);
  return image;
}

// Offers the contact with one candidate. If `time` is kTouching, contact_time() determines the
// time.
template <int D>
void Prediction<D>::offer_particle(std::uint32_t particle, const Candidates<D>& near, int i,
                                   double time, Plan<D>& plan) const {
  const std::uint32_t partner = particle_of<D>(near.neighbours[i]);
  const Vec<D> image = image_of(particle, near, i);
  if (time == kTouching) {
    const Domain<D>& domain = boundary_.domain();
    time = contact_time<D>(particles_[particle].flight, particles_[partner].flight,
                           domain.shift(image), radius_of(particle) + radius_of(partner),
                           model_.gravity, domain.velocity_x(image));
  }
  offer(time, particle, partner, image.template cast<int>(), plan);
}

template <int D>
void Prediction<D>::weigh_each(std::uint32_t particle, const Candidates<D>& near,
                               Plan<D>& plan) const {
  for (int i = 0; i < near.size; ++i) offer_particle(particle, near, i, kTouching, plan);
}

// Copies a list of a known capacity. It copies the whole list, because its length is unpredictable.
template <int kCapacity, int D>
[[gnu::always_inline]] static inline void take(const NearListView& list, Candidates<D>& near) {
  static_assert(sizeof(NearList<kCapacity>) <= sizeof near.neighbours);
  std::memcpy(near.neighbours, list.neighbours, sizeof(NearList<kCapacity>));
  near.size = list.count;
}

// Copies the first list of a particle. All first lists of a run have the same capacity.
template <int D>
[[gnu::always_inline]] static inline void take_first(const NearListView& list,
                                                     Candidates<D>& near) {
  constexpr int kLeast = Neighbourhood<D>::kLeastCapacity, kMost = Neighbourhood<D>::kCapacity;
  if (kMost > kLeast && list.capacity > kLeast) {
    take<kMost>(list, near);
  } else {
    take<kLeast>(list, near);
  }
}

template <int D>
template <bool kFalling, bool kMixed, bool kShifted, std::size_t kParticles>
std::array<FirstContact, kParticles> Prediction<D>::first_of(
    const std::array<std::uint32_t, kParticles>& particles,
    std::array<Candidates<D>, kParticles>& near) const {
  const Domain<D>& domain = boundary_.domain();
  const auto sizes = [this] {
    if constexpr (kMixed) {
      return grains_.radii();
    } else {
      return model_.diameter;
    }
  }();
  return first_contacts<D, kFalling, kShifted>(
      reinterpret_cast<const double*>(particles_.data()), particles, near,
      {model_.box.data(), domain.sheared, domain.offset, domain.slide, near_.boxes_slid()}, sizes,
      model_.gravity.data());
}

// The fast path, which fits most events. It requires lists without continuations and wraps, and a
// unique first contact. The flights of all particles must be in the frame of the same image.
// Returns false for other lists; the plans are then invalid.
template <int D>
template <bool kFalling, bool kMixed, std::size_t kParticles>
bool Prediction<D>::look_at_plain_lists(const Requests<kParticles>& requests) const {
  std::array<std::uint32_t, kParticles> particles;
  std::array<Candidates<D>, kParticles> near;
  for (std::size_t k = 0; k < kParticles; ++k) {
    if (kMixed && near_.is_wide(requests[k].particle)) return false;
    const NearListView list = near_.near(requests[k].particle, requests[k].plan->cell);
    if (list.wraps || list.next != NearListView::kNone) return false;
    particles[k] = requests[k].particle;
    take_first(list, near[k]);
  }
  const auto first = first_of<kFalling, kMixed, false>(particles, near);
  bool unique = true;
  for (std::size_t k = 0; k < kParticles; ++k) {
    Plan<D>& plan = *requests[k].plan;
    // Whether there is a contact is unpredictable. Without a contact the time is kNever, and the
    // other members have no effect.
    plan.time = first[k].time;
    plan.partner = near[k].neighbours[first[k].candidate];
    plan.partner_flight = particles_[plan.partner].flight.number;
    plan.image.setZero();
    unique = unique && first[k].unique;
  }
  return unique;
}

// Any lists.
template <int D>
template <bool kFalling, bool kMixed, std::size_t kParticles>
void Prediction<D>::look_at_lists(const Requests<kParticles>& requests) const {
  if constexpr (kMixed) {
    bool any_wide = false;
    for (const Request& request : requests) any_wide = any_wide || near_.is_wide(request.particle);
    if (any_wide) {
      for (const Request& request : requests) {
        if (near_.is_wide(request.particle)) {
          look_at_wide_lists<kFalling>(request);
        } else {
          look_at_first_lists<kFalling, true, 1>({request});
        }
      }
      return;
    }
  }
  look_at_first_lists<kFalling, kMixed>(requests);
}

// Appends the neighbours of a list whose cell is in another image. A neighbour two boxes away
// cannot touch.
template <int D>
static void take_image(const NearListView& list, const IntVec<D>& image, Candidates<D>& near) {
  near.size = 0;
  for (int k = 0; k < list.count; ++k) {
    Neighbour neighbour = particle_of<D>(list.neighbours[k]);
    bool is_near = true;
    for (int axis = 0; axis < D; ++axis) {
      const int wrap = wrap_of<D>(list.neighbours[k], axis) + image[axis];
      is_near = is_near && std::abs(wrap) <= 1;
      neighbour |= (static_cast<Neighbour>(wrap) & 3u) << (kParticleBits<D> + 2 * axis);
    }
    if (is_near) near.neighbours[near.size++] = neighbour;
  }
}

// The lists of a large particle among small ones.
template <int D>
template <bool kFalling>
void Prediction<D>::look_at_wide_lists(const Request& request) const {
  const auto [particle, plan] = request;
  wide_.clear();
  near_.visit_wide(particle, plan->cell, [this](const auto& list, const IntVec<D>& image) {
    wide_.emplace_back(NearListView(list), image);
  });
  plan->time = kNever;
  for (const auto& [first_list, image] : wide_) {
    for (NearListView list = first_list;; list = near_.next(list)) {
      std::array<Candidates<D>, 1> near;
      if (!image.isZero()) {
        take_image<D>(list, image, near[0]);
      } else if (list.capacity == kContinuedCapacity) {
        take<kContinuedCapacity>(list, near[0]);
      } else {
        take<Neighbourhood<D>::kCapacity>(list, near[0]);
      }
      const FirstContact first = first_of<kFalling, true, true, 1>({particle}, near)[0];
      offer_first(particle, near[0], first, *plan);
      if (list.next == NearListView::kNone) break;
    }
  }
}

// The first lists of all particles are searched together, then their continuations.
template <int D>
template <bool kFalling, bool kMixed, std::size_t kParticles>
void Prediction<D>::look_at_first_lists(const Requests<kParticles>& requests) const {
  std::array<std::uint32_t, kParticles> particles;
  std::array<Candidates<D>, kParticles> near;
  for (std::size_t k = 0; k < kParticles; ++k) {
    particles[k] = requests[k].particle;
    take_first(near_.near(particles[k], requests[k].plan->cell), near[k]);
  }
  const auto first = first_of<kFalling, kMixed, true>(particles, near);
  for (std::size_t k = 0; k < kParticles; ++k) {
    Plan<D>& plan = *requests[k].plan;
    plan.time = kNever;
    offer_first(particles[k], near[k], first[k], plan);
    NearListView list = near_.near(particles[k], plan.cell);
    while (list.next != NearListView::kNone) {
      list = near_.next(list);
      std::array<Candidates<D>, 1> more;
      take<kContinuedCapacity>(list, more[0]);
      const FirstContact of_more = first_of<kFalling, kMixed, true, 1>({particles[k]}, more)[0];
      offer_first(particles[k], more[0], of_more, plan);
    }
  }
}

// Offers the first contact of a particle with the candidates of one list.
template <int D>
void Prediction<D>::offer_first(std::uint32_t particle, const Candidates<D>& near,
                                const FirstContact& first, Plan<D>& plan) const {
  if (!first.unique) {
    weigh_each(particle, near, plan);
  } else if (first.time <= plan.time) {
    offer_particle(particle, near, first.candidate, first.time, plan);
  }
}

// The exits from the cells of a sheared box, which move with the flow.
template <int D>
void Prediction<D>::offer_flow_exits(const Request& request, double now) const {
  const auto [particle, plan] = request;
  for (const Exit& exit :
       near_.flow_exits(boundary_.domain(), particles_, particle, plan->cell, now)) {
    offer_exit(exit, *plan);
  }
}

// A wall's reach is slightly farther than the wall moves in, so that rounding at a cell's border
// does not matter.
template <int D>
void Prediction<D>::look_at_walls(std::uint32_t particle, double now, Plan<D>& plan) const {
  for (int axis = 0; axis < D; ++axis) {
    if (model_.periodic(axis)) continue;
    for (const int side : {2 * axis, 2 * axis + 1}) {
      const double reach = 0.51 * model_.diameter + boundary_.innermost_travel(side);
      if (near_.distance_from_end(particle, plan.cell, axis, side % 2) > reach) continue;
      offer(boundary_.contact_time(side, particles_[particle].flight, radius_of(particle), now),
            particle, kWall + static_cast<std::uint32_t>(side), IntVec<D>::Zero(), plan);
    }
  }
}

template <int D>
void Prediction<D>::look_at_fixtures(std::uint32_t particle, Plan<D>& plan) const {
  for (const auto& [number, image] : near_.pieces_near(plan.cell)) {
    const auto& [piece, fixture, valve] = near_.piece(number);
    const bool passes =
        !grains_.empty() && model_.fixtures[fixture].lets_pass(grains_[particle].species);
    if (passes) continue;
    const Vec<D> from = particles_.image(particle) + image.template cast<double>();
    const Flight<D>& flight = particles_[particle].flight;
    const Vec<D> shift = boundary_.domain().shift(-from);
    const double time =
        valve == PieceLists<D>::kNoValve
            ? piece_contact_time<D>(piece, flight, shift, radius_of(particle), model_.gravity)
            : crossing_time<D>(piece, flight, shift, model_.gravity);
    offer(time, particle, kPiece + number, -from.template cast<int>(), plan);
  }
}

// A contact at the same time keeps precedence. A NaN compares as false, and std::min then returns
// its first argument.
template <int D>
void Prediction<D>::offer_exit(const Exit& exit, Plan<D>& plan) const {
  plan.partner += (exit.time < plan.time) * (exit.border - plan.partner);
  plan.time = std::min(plan.time, exit.time);
}

template <int D>
template <bool kFalling, bool kMixed, bool kPlain, std::size_t kParticles>
void Prediction<D>::make_plans(const Requests<kParticles>& requests, double now) const {
  if constexpr (kPlain) {
    if (!look_at_plain_lists<kFalling, kMixed>(requests)) [[unlikely]] {
      planners_.template any<kParticles>()(*this, requests, now);
      return;
    }
  } else {
    look_at_lists<kFalling, kMixed>(requests);
  }
  for (const auto& [particle, plan] : requests) {
    if (!kFalling && boundary_.domain().sheared) [[unlikely]] {
      offer_flow_exits({particle, plan}, now);
      continue;
    }
    for (const Exit& exit :
         near_.template exits<kFalling>(model_, particles_, particle, plan->cell, now)) {
      offer_exit(exit, *plan);
    }
  }
  if (!walled_) return;
  for (const auto& [particle, plan] : requests) {
    look_at_walls(particle, now, *plan);
    if (near_.has_pieces()) look_at_fixtures(particle, *plan);
  }
}

template <int D>
template <bool kFalling, bool kMixed, bool kPlain, std::size_t kParticles>
void Prediction<D>::plan_baseline(const Prediction& prediction,
                                  const Requests<kParticles>& requests, double now) {
  prediction.make_plans<kFalling, kMixed, kPlain>(requests, now);
}

template <int D>
void Prediction<D>::plan_each(const Prediction& prediction, const Requests<2>& requests,
                              double now) {
  for (const Request& request : requests) {
    prediction.planners_.any_one(prediction, {request}, now);
  }
}

#if defined(__x86_64__)
template <int D>
template <bool kFalling, bool kMixed, bool kPlain, std::size_t kParticles>
void Prediction<D>::plan_avx2(const Prediction& prediction, const Requests<kParticles>& requests,
                              double now) {
  prediction.make_plans<kFalling, kMixed, kPlain>(requests, now);
}
#endif

template <int D>
template <bool kFalling, bool kMixed>
typename Prediction<D>::Planners Prediction<D>::widest_planners() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    return {plan_avx2<kFalling, kMixed, true, 1>, plan_avx2<kFalling, kMixed, true, 2>,
            plan_avx2<kFalling, kMixed, false, 1>, plan_avx2<kFalling, kMixed, false, 2>};
  }
#endif
  return {plan_baseline<kFalling, kMixed, true, 1>, plan_baseline<kFalling, kMixed, true, 2>,
          plan_baseline<kFalling, kMixed, false, 1>, plan_each};
}

template class Prediction<2>;
template class Prediction<3>;

}  // namespace clatter
