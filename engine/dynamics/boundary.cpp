#include "engine/dynamics/boundary.h"

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
Boundary<D>::Boundary(const Model<D>& model, const Clock& clock,
                      const std::array<double, 2 * D>& phase_shifts)
    : model_(model), phase_shifts_(phase_shifts) {
  move_base(clock);
}

template <int D>
void Boundary<D>::move_base(const Clock& clock) {
  const std::array<WallMotion, 2 * D> motions = wall_motions<D>(model_);
  for (int side = 0; side < 2 * D; ++side) {
    if (!model_.walls[side] || !model_.walls[side]->moves()) continue;
    motions_[side] = motions[side];
    motions_[side]->phase =
        clock.periods(motions[side].frequency, motions[side].phase + phase_shifts_[side]);
  }
}

template <int D>
WallState Boundary<D>::wall(int side, double time) const {
  return motions_[side] ? wall_state(*motions_[side], time) : WallState{};
}

template <int D>
double Boundary<D>::touching_place(int side, double time) const {
  return model_.wall_plane(side / 2, side % 2) + inward(side) * wall(side, time).displacement;
}

template <int D>
double Boundary<D>::contact_time(int side, const Flight<D>& flight, double now) const {
  const int axis = side / 2;
  const double plane = model_.wall_plane(axis, side % 2);
  if (!motions_[side]) {
    return plane_contact_time<D>(flight, axis, plane, inward(side), model_.gravity);
  }
  const auto contact_from = [&](double time) {
    const double place = flight.at(time, model_.gravity)[axis];
    const double speed = flight.velocity_at(time, model_.gravity)[axis];
    return moving_wall_contact(*motions_[side], time, inward(side) * (place - plane),
                               inward(side) * speed, inward(side) * model_.gravity[axis]);
  };
  // A move of the base rounds the wall's phase again. A particle that left the wall within rounding
  // then seems to touch it in the past. A contact in the past is not an event.
  const double contact = contact_from(flight.time);
  return contact < now ? contact_from(now) : contact;
}

template <int D>
double Boundary<D>::innermost_travel(int side) const {
  return model_.walls[side] ? model_.walls[side]->innermost_travel() : 0.0;
}

template std::array<WallMotion, 4> wall_motions<2>(const Model<2>&);
template std::array<WallMotion, 6> wall_motions<3>(const Model<3>&);
template class Boundary<2>;
template class Boundary<3>;

}  // namespace clatter
