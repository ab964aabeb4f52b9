#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/laws/fixture.h"
#include "engine/physics/lattice.h"
#include "engine/physics/random.h"
#include "engine/stop_request.h"

namespace clatter {

/// Random sequential insertion of centres, each uniform over the free room, in parts. The process
/// jams at a packing fraction of 0.547 for disks (Feder 1980) and 0.384 for spheres (Torquato, Uche
/// & Stillinger 2006).
template <int D>
class RandomInsertion {
 public:
  /// Begins the insertion of `count` centres between fixtures in the room. `random` must outlive
  /// the insertion.
  RandomInsertion(const Room<D>& room, int count, Random& random,
                  const FixtureImages<D>& fixtures = FixtureImages<D>());
  RandomInsertion(const RandomInsertion&) = delete;
  RandomInsertion& operator=(const RandomInsertion&) = delete;
  ~RandomInsertion();

  /// Inserts this centre if it has room, and returns whether it has. To be called before advance().
  bool place_first(const Vec<D>& point);
  /// Continues until all centres have their places, or one finds no room. Returns false at a
  /// request to pause; the pauses do not change the result.
  bool advance(const StopRequest& pause = {});
  /// Number of centres so far.
  std::size_t placed() const;
  /// [count] all centres; empty if one finds no room.
  std::vector<Vec<D>> take();

  struct Work;  ///< the insertion in a sparse or a dense room

 private:
  std::size_t count_;
  Random& random_;
  std::unique_ptr<Work> work_;
};

/// The same at once: [count] centres; empty if one finds no room.
template <int D>
std::vector<Vec<D>> random_insertion(const Room<D>& room, int count, Random& random);

}  // namespace clatter
