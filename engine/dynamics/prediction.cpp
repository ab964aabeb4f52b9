#include "engine/dynamics/prediction.h"

#include <algorithm>

namespace clatter {

template <int D>
void Prediction<D>::plan(std::uint32_t disk, double now, Plan<D>& plan) const {
  plan.contact = kNever;
  look_at_disks(disk, {}, plan);
  look_at_walls(disk, plan);
  look_at_borders(disk, now, plan);
}

template <int D>
void Prediction<D>::plan_entered(std::uint32_t disk, double now, int axis, int step,
                                 Plan<D>& plan) const {
  typename CellGrid<D>::Stencil ahead;
  ahead.from[axis] = ahead.to[axis] = step;
  look_at_disks(disk, ahead, plan);
  look_at_walls(disk, plan);
  look_at_borders(disk, now, plan);
}

// Whether the pair's image comes first where one pair touches through two images at once; the same
// from either side.
template <int D>
static bool image_before(const IntVec<D>& a, const IntVec<D>& b, bool swap) {
  const IntVec<D> u = swap ? IntVec<D>(-a) : a;
  const IntVec<D> w = swap ? IntVec<D>(-b) : b;
  return std::lexicographical_compare(u.begin(), u.end(), w.begin(), w.end());
}

template <int D>
void Prediction<D>::offer(double time, std::uint32_t disk, std::uint32_t partner,
                          const Vec<D>& image, Plan<D>& plan) const {
  if (time > plan.contact || time == kNever) return;
  const IntVec<D> whole = image.template cast<int>();
  if (time == plan.contact) {
    const bool first = partner < plan.partner ||
                       (partner == plan.partner && image_before<D>(whole, plan.image, partner < disk));
    if (!first) return;
  }
  plan.contact = time;
  plan.partner = partner;
  plan.partner_flight = partner < kWall ? disks_[partner].flight.number : 0;
  plan.image = whole;
}

template <int D>
void Prediction<D>::look_at_disks(std::uint32_t disk, const typename CellGrid<D>::Stencil& stencil,
                                  Plan<D>& plan) const {
  const Disk<D>& self = disks_[disk];
  grid_.visit(plan.cell, stencil, [&](std::uint32_t other, const Vec<D>& wrap) {
    if (other == disk) return;
    const Disk<D>& partner = disks_[other];
    const Vec<D> image = partner.image - self.image - wrap;
    const Vec<D> shift = image.cwiseProduct(model_.box);
    const double time = contact_time<D>(self.flight, partner.flight, shift, model_.diameter);
    offer(time, disk, other, image, plan);
  });
}

template <int D>
void Prediction<D>::look_at_walls(std::uint32_t disk, Plan<D>& plan) const {
  const Flight<D>& flight = disks_[disk].flight;
  for (int axis = 0; axis < D; ++axis) {
    if (model_.periodic(axis)) continue;
    for (const int end : {0, 1}) {
      if (plan.cell[axis] != (end ? grid_.counts()[axis] - 1 : 0)) continue;
      const double time = plane_contact_time<D>(flight, axis, model_.wall_plane(axis, end),
                                                end ? -1.0 : 1.0);
      offer(time, disk, kWall + static_cast<std::uint32_t>(2 * axis + end), Vec<D>::Zero(), plan);
    }
  }
}

template <int D>
void Prediction<D>::look_at_borders(std::uint32_t disk, double now, Plan<D>& plan) const {
  const Disk<D>& self = disks_[disk];
  plan.crossing = kNever;
  for (int axis = 0; axis < D; ++axis) {
    const double v = self.flight.v[axis];
    if (v == 0.0) continue;
    const int step = v > 0.0 ? 1 : -1;
    const int next = plan.cell[axis] + step;
    if (!model_.periodic(axis) && (next < 0 || next >= grid_.counts()[axis])) continue;
    const double border = grid_.border(axis, step > 0 ? next : plan.cell[axis]) +
                          self.image[axis] * model_.box[axis];
    const double time = std::max(now, self.flight.time + (border - self.flight.r[axis]) / v);
    if (time < plan.crossing) {
      plan.crossing = time;
      plan.crossing_axis = static_cast<std::int8_t>(axis);
      plan.crossing_step = static_cast<std::int8_t>(step);
    }
  }
}

template class Prediction<2>;

}  // namespace clatter
