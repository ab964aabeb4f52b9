#pragma once

#include <array>
#include <cstdint>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/cell_grid.h"
#include "engine/dynamics/disk.h"
#include "engine/dynamics/event.h"
#include "engine/dynamics/large_array.h"
#include "engine/dynamics/model.h"
#include "engine/physics/contact.h"
#include "engine/physics/contact_kernel.h"

namespace clatter {

/// What a disk in its cell will do next: its first contact there, or leave the cell.
template <int D>
struct Plan {
  double time = kNever;                 ///< kNever: it rests, and nothing comes near
  std::uint32_t partner = 0;            ///< as in an Event
  std::uint32_t partner_flight = 0;     ///< number of the partner's flight that the contact is with
  IntVec<D> image = IntVec<D>::Zero();  ///< box lengths to add to this disk's r minus the partner's
  IntVec<D> cell = IntVec<D>::Zero();
};

/// Finds what a disk will do next, from stored states alone.
template <int D>
class Prediction {
 public:
  /// Looks at the model, the walls, the disks and the grid of a simulation, which outlive it.
  Prediction(const Model<D>& model, const Boundary<D>& boundary, const LargeArray<Disk<D>>& disks,
             const CellGrid<D>& grid);

  /// The first contact with any disk or wall about the disk's cell, or its way out of the cell.
  void plan(std::uint32_t disk, double now, Plan<D>& plan) const;

 private:
  void look_at_disks(std::uint32_t disk, Plan<D>& plan) const;
  void weigh(std::uint32_t disk, Candidates<D>& near, Plan<D>& plan) const;
  void weigh_each(std::uint32_t disk, const Candidates<D>& near, Plan<D>& plan) const;
  Vec<D> image_of(std::uint32_t disk, const Candidates<D>& near, int i) const;
  void offer_disk(std::uint32_t disk, const Candidates<D>& near, int i, double time,
                  Plan<D>& plan) const;
  void look_at_walls(std::uint32_t disk, double now, Plan<D>& plan) const;
  void look_at_borders(std::uint32_t disk, double now, int axis, Plan<D>& plan) const;
  void look_at_borders_falling(std::uint32_t disk, double now, int axis, Plan<D>& plan) const;
  void offer_border(double time, int axis, bool upper, Plan<D>& plan) const;
  void offer(double time, std::uint32_t disk, std::uint32_t partner, const IntVec<D>& image,
             Plan<D>& plan) const;

  const Model<D>& model_;
  const Boundary<D>& boundary_;
  const LargeArray<Disk<D>>& disks_;
  const CellGrid<D>& grid_;
  bool walled_;  // whether there are walls
  FirstContactKernel<D>* first_contact_;
  std::array<double, 2 * D> reach_;  // from the box's edge: where the side's wall can be touched
};

extern template class Prediction<2>;

}  // namespace clatter
