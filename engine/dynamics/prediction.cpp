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
static_assert(Candidates<2>::kCapacity >= CellGrid<2>::List::kCapacity);

template <int D>
Prediction<D>::Prediction(const Model<D>& model, const Boundary<D>& boundary,
                          const LargeArray<Disk<D>>& disks, const CellGrid<D>& grid)
    : model_(model),
      boundary_(boundary),
      disks_(disks),
      grid_(grid),
      walled_(std::any_of(model.walls.begin(), model.walls.end(), [](const auto& w) { return w; })),
      first_contact_(first_contact_kernel<D>((model.gravity.array() != 0.0).any())) {
  // Farther than the wall comes, so that rounding at a cell's border does not matter.
  for (int side = 0; side < 2 * D; ++side) {
    reach_[side] = 0.51 * model.diameter + boundary.innermost_travel(side);
  }
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
  if (time > plan.time || time == kNever) return;
  if (time == plan.time) {
    const bool first =
        partner < plan.partner ||
        (partner == plan.partner && image_before<D>(image, plan.image, partner < disk));
    if (!first) return;
  }
  plan.time = time;
  plan.partner = partner;
  plan.partner_flight = partner < kWall ? disks_[partner].flight.number : 0;
  plan.image = image;
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

// Kept apart, for what it needs would slow down who never comes here.
template <int D>
[[gnu::noinline]] void Prediction<D>::weigh_each(std::uint32_t disk, const Candidates<D>& near,
                                                 Plan<D>& plan) const {
  for (int i = 0; i < near.size; ++i) offer_disk(disk, near, i, kTouching, plan);
}

template <int D>
void Prediction<D>::weigh(std::uint32_t disk, Candidates<D>& near, Plan<D>& plan) const {
  const FirstContact first =
      first_contact_(disks_.data()->flight.r.data(), disk, near, model_.box.data(), model_.diameter,
                     model_.gravity.data());
  if (!first.told_apart) [[unlikely]] {
    weigh_each(disk, near, plan);
  } else if (plan.time == kNever) {
    // Whether there is a contact cannot be foreseen: without one, what is set says so all the same.
    plan.time = first.time;
    plan.partner = near.disks[first.candidate];
    plan.partner_flight = disks_[plan.partner].flight.number;
    plan.image = image_of(disk, near, first.candidate).template cast<int>();
  } else if (first.time <= plan.time) {
    offer_disk(disk, near, first.candidate, first.time, plan);
  }
}

// Tells apart the numbers of those on a list and their ways round the periodic borders.
template <int D>
[[gnu::noinline]] static void unwrap(const typename CellGrid<D>::List& list, Candidates<D>& near) {
  for (int i = 0; i < near.size; ++i) {
    near.disks[i] = CellGrid<D>::disk_of(list.neighbours[i]);
    for (int k = 0; k < D; ++k) near.wraps[k][i] = CellGrid<D>::wrap_of(list.neighbours[i], k);
  }
}

template <int D>
void Prediction<D>::look_at_disks(std::uint32_t disk, Plan<D>& plan) const {
  using List = typename CellGrid<D>::List;
  Candidates<D> near;
  for (const List* list = &grid_.near(plan.cell); list; list = grid_.next(*list)) {
    // A whole list, for how many are on it cannot be foreseen.
    std::memcpy(near.disks, list->neighbours.data(), sizeof list->neighbours);
    near.size = static_cast<int>(list->count);
    near.wrapped = list->wraps;
    if (near.wrapped) [[unlikely]]
      unwrap<D>(*list, near);
    weigh(disk, near, plan);
  }
}

template <int D>
void Prediction<D>::look_at_walls(std::uint32_t disk, double now, Plan<D>& plan) const {
  for (int axis = 0; axis < D; ++axis) {
    if (model_.periodic(axis)) continue;
    for (const int side : {2 * axis, 2 * axis + 1}) {
      if (grid_.distance_from_end(axis, plan.cell[axis], side % 2) > reach_[side]) continue;
      offer(boundary_.contact_time(side, disks_[disk].flight, now), disk,
            kWall + static_cast<std::uint32_t>(side), IntVec<D>::Zero(), plan);
    }
  }
}

// The partner of a contact at the same time stays. A time that is not a number is less than none,
// and std::min then returns its first.
template <int D>
void Prediction<D>::offer_border(double time, int axis, bool upper, Plan<D>& plan) const {
  const std::uint32_t border = kCellBorder + static_cast<std::uint32_t>(2 * axis + upper);
  plan.partner += (time < plan.time) * (border - plan.partner);
  plan.time = std::min(plan.time, time);
}

// Written without branches, for neither the signs of the velocity nor what comes first can be
// foreseen.
template <int D>
void Prediction<D>::look_at_borders(std::uint32_t disk, double now, int axis, Plan<D>& plan) const {
  const Disk<D>& self = disks_[disk];
  const double v = self.flight.v[axis];
  const bool upper = v >= 0.0;
  const double place =
      grid_.border(axis, plan.cell[axis], upper) + self.image[axis] * model_.box[axis];
  // v + 0.0 is no negative zero: a disk at rest comes to the border above it at infinity.
  const double time = self.flight.time + (place - self.flight.r[axis]) / (v + 0.0);
  offer_border(std::max(now, time), axis, upper, plan);
}

// A disk on a parabola may leave through the border by which it came. It is looked at from where it
// is now: a crossing, unlike a contact, need not be a function of the stored state alone.
template <int D>
void Prediction<D>::look_at_borders_falling(std::uint32_t disk, double now, int axis,
                                            Plan<D>& plan) const {
  const Disk<D>& self = disks_[disk];
  const double a = model_.gravity[axis];
  const double since = now - self.flight.time;
  const double r = self.flight.r[axis] + (self.flight.v[axis] + a * (0.5 * since)) * since -
                   self.image[axis] * model_.box[axis];
  const double v = self.flight.v[axis] + a * since;
  const double lower = grid_.border(axis, plan.cell[axis], false);
  const double upper = grid_.border(axis, plan.cell[axis], true);
  const WayOut out = way_out(r - lower, upper - r, v, a);
  double time = now + out.time;
  // Who turns just beyond a border returns later, be it by the least time that there is.
  if (time == now && (v < 0.0) == out.upper) [[unlikely]]
    time = std::nextafter(now, kNever);
  offer_border(time, axis, out.upper, plan);
}

template <int D>
void Prediction<D>::plan(std::uint32_t disk, double now, Plan<D>& plan) const {
  plan.time = kNever;
  look_at_disks(disk, plan);
  if (walled_) look_at_walls(disk, now, plan);
  for (int axis = 0; axis < D; ++axis) {
    if (model_.gravity[axis] == 0.0) {
      look_at_borders(disk, now, axis, plan);
    } else {
      look_at_borders_falling(disk, now, axis, plan);
    }
  }
}

template class Prediction<2>;

}  // namespace clatter
