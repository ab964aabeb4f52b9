#include "engine/dynamics/prediction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace clatter {

// Disks are what contact kernels read as rows of doubles.
static_assert(sizeof(Disk<2>) == kRowLength<2> * sizeof(double));
static_assert(offsetof(Disk<2>, flight) == 0 && offsetof(Flight<2>, v) == 2 * sizeof(double) &&
              offsetof(Flight<2>, time) == 4 * sizeof(double) &&
              offsetof(Disk<2>, image) == 6 * sizeof(double));
// They hold the first lines of a neighbourhood.
static_assert(Candidates<2>::kCapacity >= 9 * CellGrid<2>::Line::kCapacity);

template <int D>
Prediction<D>::Prediction(const Model<D>& model, const Boundary<D>& boundary,
                          const LargeArray<Disk<D>>& disks, const CellGrid<D>& grid)
    : model_(model),
      boundary_(boundary),
      disks_(disks),
      grid_(grid),
      falling_((model.gravity.array() != 0.0).any()),
      first_contact_(first_contact_kernel<D>(falling_)) {
  // Farther than the wall comes, so that rounding at a cell's border does not matter.
  for (int side = 0; side < 2 * D; ++side) {
    reach_[side] = 0.51 * model.diameter + boundary.innermost_travel(side);
  }
}

// Copies a whole line, for how many disks it holds cannot be foreseen.
template <int D>
[[gnu::always_inline]] static inline void copy(const typename CellGrid<D>::Line& line,
                                               const Vec<D>* wrap, int to, Candidates<D>& near) {
  std::memcpy(near.disks + to, line.disks.data(), sizeof line.disks);
  if (!wrap) return;
  for (int k = 0; k < D; ++k) std::fill_n(near.wraps[k] + to, line.disks.size(), (*wrap)[k]);
  near.wrapped = true;
}

// Inlined by force, so that the loops over a whole neighbourhood are unrolled.
template <int D>
[[gnu::always_inline]] inline void Prediction<D>::look_at_disks(std::uint32_t disk,
                                                                const Stencil& stencil,
                                                                Plan<D>& plan) const {
  Candidates<D> near;
  int size = 0;
  bool full = false;
  const auto add = [&](const Line& line, const Vec<D>* wrap) __attribute__((always_inline)) {
    const int count = static_cast<int>(line.count);
    copy<D>(line, wrap, size, near);
    if (count == Line::kCapacity) [[unlikely]]
      full = true;
    size += count;
  };
  grid_.visit_first_lines(plan.cell, stencil, add);
  if (full) [[unlikely]]
    size = add_chained(disk, stencil, size, near, plan);
  weigh(disk, near, size, plan);
}

// Returns the size with what crowded cells hold beyond their first lines.
template <int D>
int Prediction<D>::add_chained(std::uint32_t disk, const Stencil& stencil, int size,
                               Candidates<D>& near, Plan<D>& plan) const {
  grid_.visit_chained_lines(plan.cell, stencil, [&](const Line& line, const Vec<D>* wrap) {
    if (size + Line::kCapacity > Candidates<D>::kCapacity) {
      weigh(disk, near, size, plan);
      size = 0;
    }
    copy<D>(line, wrap, size, near);
    size += static_cast<int>(line.count);
  });
  return size;
}

template <int D>
void Prediction<D>::plan(std::uint32_t disk, double now, Plan<D>& plan) const {
  plan.contact = kNever;
  look_at_disks(disk, {}, plan);
  look_at_walls(disk, now, plan);
  falling_ ? look_at_borders_falling(disk, now, plan) : look_at_borders(disk, now, plan);
}

template <int D>
void Prediction<D>::plan_entered(std::uint32_t disk, double now, int axis, int step,
                                 Plan<D>& plan) const {
  Stencil ahead;
  ahead.from[axis] = ahead.to[axis] = step;
  look_at_disks(disk, ahead, plan);
  look_at_walls(disk, now, plan);
  falling_ ? look_at_borders_falling(disk, now, plan) : look_at_borders(disk, now, plan);
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
                          const IntVec<D>& image, Plan<D>& plan) const {
  if (time > plan.contact || time == kNever) return;
  if (time == plan.contact) {
    const bool first =
        partner < plan.partner ||
        (partner == plan.partner && image_before<D>(image, plan.image, partner < disk));
    if (!first) return;
  }
  plan.contact = time;
  plan.partner = partner;
  plan.partner_flight = partner < kWall ? disks_[partner].flight.number : 0;
  plan.image = image;
}

template <int D>
void Prediction<D>::weigh(std::uint32_t disk, Candidates<D>& near, int size, Plan<D>& plan) const {
  near.size = size;
  const FirstContact first =
      first_contact_(disks_.data()->flight.r.data(), disk, near, model_.box.data(), model_.diameter,
                     model_.gravity.data());
  if (!first.told_apart) {
    for (int i = 0; i < size; ++i) offer_disk(disk, near, i, kTouching, plan);
  } else if (plan.contact == kNever) {
    // Whether there is a contact cannot be foreseen: without one, what is set says so all the same.
    plan.contact = first.time;
    plan.partner = near.disks[first.candidate];
    plan.partner_flight = disks_[plan.partner].flight.number;
    plan.image = image_of(disk, near, first.candidate).template cast<int>();
  } else if (first.time <= plan.contact) {
    offer_disk(disk, near, first.candidate, first.time, plan);
  }
}

// Box lengths to add to a disk's r minus a candidate's.
template <int D>
Vec<D> Prediction<D>::image_of(std::uint32_t disk, const Candidates<D>& near, int i) const {
  Vec<D> image = disks_[near.disks[i]].image - disks_[disk].image;
  if (near.wrapped) {
    for (int k = 0; k < D; ++k) image[k] -= near.wraps[k][i];
  }
  return image;
}

// The contact with one candidate, at its known time, or at one still to be found if that is
// kTouching.
template <int D>
void Prediction<D>::offer_disk(std::uint32_t disk, const Candidates<D>& near, int i, double time,
                               Plan<D>& plan) const {
  const Vec<D> image = image_of(disk, near, i);
  if (time == kTouching) {
    const Vec<D> shift = image.cwiseProduct(model_.box);
    time = contact_time<D>(disks_[disk].flight, disks_[near.disks[i]].flight, shift,
                           model_.diameter, model_.gravity);
  }
  offer(time, disk, near.disks[i], image.template cast<int>(), plan);
}

template <int D>
void Prediction<D>::look_at_walls(std::uint32_t disk, double now, Plan<D>& plan) const {
  for (int axis = 0; axis < D; ++axis) {
    if (model_.periodic(axis)) continue;
    for (const int side : {2 * axis, 2 * axis + 1}) {
      const int cells_off = side % 2 ? grid_.counts()[axis] - 1 - plan.cell[axis] : plan.cell[axis];
      if (cells_off * grid_.width(axis) > reach_[side]) continue;
      offer(boundary_.contact_time(side, disks_[disk].flight, now), disk,
            kWall + static_cast<std::uint32_t>(side), IntVec<D>::Zero(), plan);
    }
  }
}

// Written without branches on the velocity's signs, which nothing foretells.
template <int D>
void Prediction<D>::look_at_borders(std::uint32_t disk, double now, Plan<D>& plan) const {
  const Disk<D>& self = disks_[disk];
  double first = kNever;
  int first_axis = 0;
  for (int axis = 0; axis < D; ++axis) {
    const double v = self.flight.v[axis];
    const double place =
        grid_.border(axis, plan.cell[axis] + (v > 0.0)) + self.image[axis] * model_.box[axis];
    const double time = self.flight.time + (place - self.flight.r[axis]) / v;
    const double crossing = v != 0.0 ? std::max(now, time) : kNever;
    first_axis += (crossing < first) * (axis - first_axis);
    first = std::min(first, crossing);
  }
  plan.crossing = first;
  plan.crossing_axis = static_cast<std::int8_t>(first_axis);
  plan.crossing_step = self.flight.v[first_axis] > 0.0 ? 1 : -1;
}

// A disk on a parabola may leave through the border by which it came. It is looked at from where it
// is now: a crossing, unlike a contact, need not be a function of the stored state alone.
template <int D>
void Prediction<D>::look_at_borders_falling(std::uint32_t disk, double now, Plan<D>& plan) const {
  const Disk<D>& self = disks_[disk];
  const Vec<D> r = self.flight.at(now, model_.gravity);
  const Vec<D> v = self.flight.velocity_at(now, model_.gravity);
  plan.crossing = kNever;
  for (int axis = 0; axis < D; ++axis) {
    for (const int step : {-1, 1}) {
      const int border = plan.cell[axis] + (step > 0);
      const bool outer = border == 0 || border == grid_.counts()[axis];
      if (outer && !model_.periodic(axis)) continue;
      const double place = grid_.border(axis, border) + self.image[axis] * model_.box[axis];
      const double recession = -step * v[axis];
      double time =
          now + fall_time(step * (place - r[axis]), recession, -step * model_.gravity[axis]);
      // Who turns just beyond a border returns later, be it by the least time that there is.
      if (recession > 0.0 && time == now) time = std::nextafter(now, kNever);
      if (time >= plan.crossing) continue;
      plan.crossing = time;
      plan.crossing_axis = static_cast<std::int8_t>(axis);
      plan.crossing_step = static_cast<std::int8_t>(step);
    }
  }
}

template class Prediction<2>;

}  // namespace clatter
