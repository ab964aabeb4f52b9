#pragma once

#include <cstdint>

#include "engine/vec.h"

namespace clatter {

/// Free flight of a disk: a straight line through `r` at `time`.
template <int D>
struct Flight {
  Vec<D> r = Vec<D>::Zero();  ///< centre at `time`; may lie whole box lengths outside the box
  Vec<D> v = Vec<D>::Zero();  ///< velocity since `time`
  double time = 0.0;          ///< on the simulation's moving base
  std::uint32_t number = 0;   ///< physical events that the disk had before; predictions made for an
                              ///< earlier flight are stale

  /// The centre at a later time.
  Vec<D> at(double later) const { return r + v * (later - time); }
};

}  // namespace clatter
