#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/laws/domain.h"
#include "engine/laws/fixture.h"
#include "engine/physics/grain.h"
#include "engine/physics/random.h"
#include "engine/stop_request.h"
#include "engine/vec.h"

namespace clatter {

/// Random places of particles of different sizes without overlaps, in parts. The places begin as
/// uniform random points, outside of particles that are much larger. A sweep moves each overlapping
/// pair apart along the line of their centres, the smaller particle farther, and moves particles
/// out of fixtures. Below the density of
/// random close packing, 0.84 for disks and 0.64 for spheres, a sweep soon finds no overlap. The
/// places are not those of a gas in equilibrium.
template <int D>
class OverlapRemoval {
 public:
  /// Begins with random points in a box, outside of fixtures. `grains` are the particles, with
  /// radii less than half of each side of the box.
  OverlapRemoval(const Domain<D>& domain, const std::vector<Grain>& grains, Random& random,
                 const FixtureImages<D>& fixtures = FixtureImages<D>());

  /// Continues until no particles overlap, or until the overlaps no longer fall. Returns false at a
  /// request to pause; the pauses do not change the result.
  bool advance(const StopRequest& pause = {});
  /// Estimate of the completed part, 0..1: the part of the first overlaps that is gone.
  double progress() const;
  /// [N] the places; empty if particles overlap. None remain.
  std::vector<Vec<D>> take();

 private:
  /// Cells with the particles of similar diameters.
  struct Grid {
    IntVec<D> counts;  ///< of cells along each axis, each wider than the largest diameter
    Vec<D> widths;
    std::vector<std::uint32_t> members;  ///< numbers of its particles
    std::vector<std::uint32_t> first;    ///< [cells + 1] places in order
    std::vector<std::uint32_t> order;    ///< the members, by cell

    Grid(const Vec<D>& box, double diameter, std::size_t particles);
    std::uint32_t index_of(const IntVec<D>& cell) const;
  };

  void place(std::uint32_t particle, Random& random);
  bool is_free(std::uint32_t particle) const;
  void sort_into_cells(Grid& grid);
  template <typename Visit>
  void visit_near(const Grid& grid, const Vec<D>& place, Visit visit) const;
  double sweep();
  double part(std::uint32_t a, std::uint32_t b);
  double leave_fixtures(std::uint32_t particle);
  void keep_inside(std::uint32_t particle);

  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  Domain<D> domain_;
  std::vector<double> radii_;
  std::vector<std::uint32_t> species_;  // [N]
  FixtureImages<D> fixtures_;
  std::vector<Vec<D>> places_;
  std::vector<Grid> grids_;           // of diameters that halve from one to the next
  std::vector<std::uint8_t> levels_;  // [N] number of each particle's grid
  int sweeps_ = 0;
  double overlap_ = kUnknown;  // sum of the last sweep, in distances at contact
  double first_ = kUnknown;    // that of the first sweep
  double best_ = kUnknown;     // the last one that was clearly smaller than those before
  int best_sweep_ = 0;
};

extern template class OverlapRemoval<2>;
extern template class OverlapRemoval<3>;

}  // namespace clatter
