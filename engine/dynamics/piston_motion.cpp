#include "engine/dynamics/piston_motion.h"

#include "engine/physics/contact.h"
#include "engine/physics/fall_time.h"

namespace clatter {

// Half of the way of the piston, in diameters, for which a zone lasts.
static constexpr double kSlack = 1.0;

template <int D>
PistonMotion<D>::PistonMotion(const PistonFlight& flight, const Model<D>& model,
                              const Boundary<D>& boundary, const ParticleArray<D>& particles,
                              const GrainArray& grains, const Neighbourhood<D>& near)
    : flight_(flight),
      model_(model),
      boundary_(boundary),
      particles_(particles),
      grains_(grains),
      near_(near) {}

template <int D>
bool PistonMotion<D>::is_near(std::uint32_t particle, const IntVec<D>& cell) const {
  const FreePiston& piston = *model_.free_piston;
  const int axis = piston.axis;
  const double reach = 0.5 * piston.thickness + (0.51 + kSlack) * model_.diameter;
  const double below = near_.distance_from_end(particle, cell, axis, false);
  const double above = near_.distance_from_end(particle, cell, axis, true);
  return below <= zone_ + reach && model_.box[axis] - above >= zone_ - reach;
}

template <int D>
void PistonMotion<D>::add(std::uint32_t particle) {
  places_[particle] = static_cast<std::uint32_t>(members_.size());
  members_.push_back(particle);
  times_.push_back(contact_of(particle));
}

template <int D>
void PistonMotion<D>::remove(std::uint32_t particle) {
  const std::uint32_t place = places_[particle], last = members_.back();
  members_[place] = last;
  times_[place] = times_.back();
  places_[last] = place;
  places_[particle] = kNotNear;
  members_.pop_back();
  times_.pop_back();
}

template <int D>
double PistonMotion<D>::contact_of(std::uint32_t particle) const {
  const FreePiston& piston = *model_.free_piston;
  return piston_contact_time<D>(particles_[particle].flight, flight_, piston.axis,
                                0.5 * piston.thickness + radius_of(particle), model_.gravity);
}

template <int D>
void PistonMotion<D>::find_own_events(double now) {
  own_ = {};
  const FreePiston& piston = *model_.free_piston;
  if (piston.pinned) return;
  const Vec<D> along = Vec<D>::Unit(piston.axis);
  const Flight<D> flight{flight_.place * along, flight_.velocity * along, flight_.time, 0};
  const auto offer = [&](double time, Cause cause, std::uint32_t number) {
    if (time < own_.time) own_ = {time, cause, number};
  };
  for (const int side : {2 * piston.axis, 2 * piston.axis + 1}) {
    offer(boundary_.contact_time(side, flight, 0.5 * piston.thickness, flight_.acceleration * along,
                                 now),
          Cause::Wall, static_cast<std::uint32_t>(side));
  }
  for (const double side : {-1.0, 1.0}) {
    const double gap = kSlack * model_.diameter - side * (flight_.at(now) - zone_);
    offer(now + fall_time(gap, -side * flight_.velocity_at(now), -side * flight_.acceleration),
          Cause::Zone, 0);
  }
}

// Contacts at the same time come in the order of the particles.
template <int D>
void PistonMotion<D>::choose_next() {
  next_ = own_;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (times_[k] > next_.time) continue;
    const bool later =
        times_[k] == next_.time && next_.cause == Cause::Particle && next_.number < members_[k];
    if (!later) next_ = {times_[k], Cause::Particle, members_[k]};
  }
}

template <int D>
void PistonMotion<D>::renew(std::uint32_t particle, const IntVec<D>& cell) {
  const bool near = is_near(particle, cell), was_near = places_[particle] != kNotNear;
  const bool was_next = next_.cause == Cause::Particle && next_.number == particle;
  if (!near && !was_near) return;
  if (near && was_near) {
    times_[places_[particle]] = contact_of(particle);
  } else if (near) {
    add(particle);
  } else {
    remove(particle);
  }
  const bool sooner = near && times_[places_[particle]] <= next_.time;
  if (was_next || sooner) choose_next();
}

template <int D>
void PistonMotion<D>::fly(const PistonFlight& flight) {
  flight_ = flight;
  for (std::size_t k = 0; k < members_.size(); ++k) times_[k] = contact_of(members_[k]);
  find_own_events(flight.time);
  choose_next();
}

template class PistonMotion<2>;
template class PistonMotion<3>;

}  // namespace clatter
