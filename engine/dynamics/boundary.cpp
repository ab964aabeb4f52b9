#include "engine/dynamics/boundary.h"

#include <algorithm>

#include "engine/physics/contact.h"

namespace clatter {

template <int D>
std::array<WallMotion, 2 * D> wall_motions(const Model<D>& model) {
  std::array<WallMotion, 2 * D> motions;
  for (int side = 0; side < 2 * D; ++side) {
    if (model.walls[side]) motions[side] = model.walls[side]->motion();
  }
  return motions;
}

template <int D>
bool keeps_flights(const Model<D>& before, const Model<D>& after) {
  const auto same = [](const Fixture<D>& a, const Fixture<D>& b) { return a.has_shape_of(b); };
  return before.gravity == after.gravity && before.shear_rate == after.shear_rate &&
         wall_motions<D>(before) == wall_motions<D>(after) &&
         std::ranges::equal(before.fixtures, after.fixtures, same);
}

template <int D>
bool keeps_flights(const RunState<D>& saved, const Model<D>& after) {
  return saved.gravity == after.gravity && saved.shear_rate == after.shear_rate &&
         saved.wall_motions == wall_motions<D>(after);
}

template <int D>
Boundary<D>::Boundary(const Model<D>& model, const Clock& clock,
                      const std::array<double, 2 * D>& phase_shifts,
                      const std::optional<PistonStroke>& piston, double shear_phase)
    : model_(model) {
  restart(clock, phase_shifts, piston, shear_phase);
}

template <int D>
void Boundary<D>::restart(const Clock& clock, const std::array<double, 2 * D>& phase_shifts,
                          const std::optional<PistonStroke>& piston, double shear_phase) {
  phase_shifts_ = phase_shifts;
  shear_phase_ = shear_phase;
  motions_ = {};
  piston_ = piston;
  move_base(clock);
}

template <int D>
void Boundary<D>::move_base(const Clock& clock) {
  domain_ = model_.domain();
  if (domain_.sheared) {
    const double length = domain_.box[0];
    domain_.offset = length * clock.periods(domain_.slide / length, shear_phase_);
  }
  const std::array<WallMotion, 2 * D> motions = wall_motions<D>(model_);
  for (int side = 0; side < 2 * D; ++side) {
    innermost_[side] = clatter::innermost_travel(motions[side]);
    if (!model_.walls[side] || !model_.walls[side]->moves()) continue;
    motions_[side] = motions[side];
    motions_[side]->phase =
        clock.periods(motions[side].frequency, motions[side].phase + phase_shifts_[side]);
  }
  if (!piston_) return;
  stroke_ = *piston_;
  stroke_.start = clock.relative(piston_->start);
  stroke_.end = clock.relative(piston_->end);
  innermost_[kRight] += piston_->innermost();
}

template <int D>
WallState Boundary<D>::wall(int side, double time) const {
  WallState state = motions_[side] ? wall_state(*motions_[side], time) : WallState{};
  if (side != kRight || !piston_) return state;
  state.displacement += stroke_.travel(time);
  if (stroke_.moves_at(time)) state.velocity += piston_->velocity();
  return state;
}

template <int D>
double Boundary<D>::touching_place(int side, double radius, double time) const {
  return model_.wall_plane(side / 2, side % 2, radius) +
         inward(side) * wall(side, time).displacement;
}

template <int D>
double Boundary<D>::contact_time(int side, const Flight<D>& flight, double radius,
                                 double now) const {
  return contact_time(side, flight, radius, model_.gravity, now);
}

// The piston's rest position moves until the end of its stroke, and rests from there on. A flight
// that began before the stroke has no contact before it, because such a contact would have ended
// the flight.
template <int D>
double Boundary<D>::contact_time(int side, const Flight<D>& flight, double radius,
                                 const Vec<D>& acceleration, double now) const {
  const bool piston = side == kRight && piston_;
  const int axis = side / 2;
  const double plane = model_.wall_plane(axis, side % 2, radius);
  if (!motions_[side] && !piston) {
    return plane_contact_time<D>(flight, axis, plane, inward(side), acceleration);
  }
  const auto contact_from = [&](double time, double rest_velocity) {
    const double rest = plane + inward(side) * (piston ? stroke_.travel(time) : 0.0);
    const double distance = inward(side) * (flight.at(time, acceleration)[axis] - rest);
    const double speed = inward(side) * flight.velocity_at(time, acceleration)[axis];
    const double inwards = inward(side) * acceleration[axis];
    if (!motions_[side] && rest_velocity == 0.0) {
      return time + fall_time(distance, speed, inwards);
    }
    return moving_wall_contact(motions_[side].value_or(WallMotion{}), time, distance, speed,
                               inwards, rest_velocity);
  };
  // A move of the base rounds the wall's phase again. A particle that left the wall within rounding
  // then seems to touch it in the past. A contact in the past is not an event.
  const auto first_contact = [&](double begin, double rest_velocity) {
    const double contact = contact_from(begin, rest_velocity);
    return contact < now ? contact_from(now, rest_velocity) : contact;
  };
  if (!piston || flight.time >= stroke_.end) return first_contact(flight.time, 0.0);
  const double contact = first_contact(std::max(flight.time, stroke_.start), stroke_.velocity());
  return contact < stroke_.end ? contact : first_contact(stroke_.end, 0.0);
}

template std::array<WallMotion, 4> wall_motions<2>(const Model<2>&);
template std::array<WallMotion, 6> wall_motions<3>(const Model<3>&);
template bool keeps_flights<2>(const Model<2>&, const Model<2>&);
template bool keeps_flights<3>(const Model<3>&, const Model<3>&);
template bool keeps_flights<2>(const RunState<2>&, const Model<2>&);
template bool keeps_flights<3>(const RunState<3>&, const Model<3>&);
template class Boundary<2>;
template class Boundary<3>;

}  // namespace clatter
