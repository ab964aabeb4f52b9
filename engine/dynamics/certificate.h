#pragma once

#include <algorithm>

namespace clatter {

/// Proof that a tile's own particles had their true collisions in a window, see docs/parallel.md. A
/// particle's way is its largest distance, in the window, from its place at the start. All lengths
/// have one unit.
class Certificate {
 public:
  /// A tile with halos of a width, whose particles touch at a distance `contact`. `farthest` is the
  /// longest way of all particles of the gas, so the tile's absent particles come no closer.
  Certificate(double width, double contact, double farthest)
      : contact_(contact), reach_(farthest - width) {}

  /// A copy has another flight at the end of the window than the particle has in the tile of its
  /// owner. `way` is its way in the tile, `true_way` that in its owner's. `distance` is its place's
  /// from the tile's core.
  void add_wrong_copy(double way, double true_way, double distance) {
    reach_ = std::max(reach_, std::max(way, true_way) - distance);
  }
  /// Length by which a wrong or absent particle may come too close to an own particle. Below 0 the
  /// tile is certified. `exposure` is the largest way of an own particle minus its depth in the
  /// core. `bend` is the length that gravity may add to each way.
  double lack(double exposure, double bend) const {
    return reach_ + exposure + 2.0 * bend + contact_;
  }

 private:
  double contact_;
  double reach_;  // of a wrong or absent particle into the core
};

}  // namespace clatter
