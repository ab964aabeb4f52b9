#pragma once

#include <array>

#include "engine/laws/model.h"
#include "engine/vec.h"

namespace clatter {

/// What lies at an end of a subdomain along an axis: its other end, a wall, the rest of the gas, or
/// the other end of a sheared box, which slides.
enum class End { Periodic, Wall, Open, Sliding };

/// The part of a gas that cells cover: the whole box or a cuboid of it. A cuboid may extend beyond
/// the periodic border of the box; its coordinates then continue there.
template <int D>
struct Subdomain {
  Vec<D> lower = Vec<D>::Zero();
  Vec<D> upper = Vec<D>::Zero();
  std::array<End, 2 * D> ends = {};  ///< lower and upper end of each axis; both or none Periodic,
                                     ///< both or none Sliding
  /// Distance of each end from the end of the box.
  std::array<double, 2 * D> to_box_end = {};

  /// Whether particles can leave the subdomain.
  bool open() const {
    for (const End end : ends) {
      if (end == End::Open) return true;
    }
    return false;
  }
};

/// The whole box.
template <int D>
Subdomain<D> whole_box(const Model<D>& model) {
  Subdomain<D> whole;
  whole.upper = model.box;
  for (int side = 0; side < 2 * D; ++side) {
    whole.ends[side] = model.periodic(side / 2) ? End::Periodic : End::Wall;
    if (model.shear_rate && side / 2 == 1) whole.ends[side] = End::Sliding;
  }
  return whole;
}

}  // namespace clatter
