#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/laws/domain.h"
#include "engine/physics/random.h"
#include "engine/stop_request.h"
#include "engine/vec.h"

namespace clatter {

/// Random places of particles of different sizes without overlaps, in parts. The places begin as
/// uniform random points. A sweep moves each overlapping pair apart along the line of their
/// centres, the smaller particle farther. Below the density of random close packing, 0.84 for disks
/// and 0.64 for spheres, a sweep soon finds no overlap. The places are not those of a gas in
/// equilibrium.
template <int D>
class OverlapRemoval {
 public:
  /// Begins with random points in a box. `radii` are those of the particles, less than half of each
  /// side of the box.
  OverlapRemoval(const Domain<D>& domain, std::vector<double> radii, Random& random);

  /// Continues until no particles overlap, or until they seem to have no room. Returns false at a
  /// request to pause; the pauses do not change the result.
  bool advance(const StopRequest& pause = {});
  /// [N] the places; empty if particles overlap. None remain.
  std::vector<Vec<D>> take();

 private:
  /// Cells with the particles of similar diameters.
  struct Grid {
    IntVec<D> counts;  ///< of cells along each axis, each wider than the largest diameter
    Vec<D> widths;
    std::vector<std::uint32_t> first;  ///< [cells + 1] places in order
    std::vector<std::uint32_t> order;  ///< numbers of particles, by cell

    Grid(const Vec<D>& box, double diameter);
  };

  void sort_into_cells();
  bool sweep();
  bool part_from(std::uint32_t particle, const Grid& grid, const IntVec<D>& cell, bool later_only);
  bool part(std::uint32_t a, std::uint32_t b);
  void keep_inside(std::uint32_t particle);

  Domain<D> domain_;
  std::vector<double> radii_;
  std::vector<Vec<D>> places_;
  std::vector<Grid> grids_;           // of diameters that halve from one to the next
  std::vector<std::uint8_t> levels_;  // [N] number of each particle's grid
  int sweeps_ = 0;
  bool overlaps_ = true;
};

extern template class OverlapRemoval<2>;
extern template class OverlapRemoval<3>;

}  // namespace clatter
