#pragma once

#include <cstdint>
#include <memory>

#include "engine/laws/fixture.h"
#include "engine/laws/model.h"
#include "engine/scene/scene.h"
#include "engine/stop_request.h"

namespace clatter {

/// The state of a scene at time 0, made in parts: see start_state().
class StartMaker {
 public:
  /// Begins the state of a scene and a seed. Throws Interrupted, also later, after a `stop`
  /// request.
  StartMaker(const Scene& scene, std::uint64_t seed, const StopRequest& stop = {});
  StartMaker(StartMaker&&) noexcept;
  StartMaker& operator=(StartMaker&&) noexcept;
  ~StartMaker();

  /// Continues until all particles have their places. Returns false at a request to pause; the
  /// pauses do not change the state.
  bool advance(const StopRequest& pause = {});
  /// Estimate of the completed part, 0..1.
  double progress() const;
  /// The state. Requires that advance() has returned true.
  AnyState take();

  struct Work;  ///< the parts that depend on the dimension

 private:
  std::unique_ptr<Work> work_;
};

/// The fixtures of a scene, for positions in a room with its corner at this place.
template <int D>
FixtureImages<D> start_fixtures(const Scene& scene, const Vec<D>& corner);

/// The state of a scene at time 0, a pure function of scene and seed. No particles overlap.
/// Velocities are Gaussian with mean 0 (N >= 2) and exactly the start temperature. Spins, if the
/// scene has them, are Gaussian with exactly their temperature I <omega^2>. Particles are outside
/// of the range of moving walls. With layout File the state comes from the file.
///
/// A random layout uses random insertion up to a packing fraction of 0.54 for disks and 0.37 for
/// spheres. There 20,000 and more particles of one diameter have the places of Growth, unless there
/// are fixtures or the layout is Insertion. Up to 0.7 and 0.54, where a fluid exists, it melts a
/// lattice. Above it is a lattice with random vacancies. From 0.49 on a crystal of spheres is
/// stable beside the fluid, and some of its order may remain. Species of one diameter have these
/// places at random, and those of several diameters have the places of OverlapRemoval. Between
/// fixtures random insertion comes first, and then OverlapRemoval. A lattice has no sites in
/// fixtures. The two sides of a divider with numbers of particles are rooms of their own. The scene
/// must be validated: its count fits one of the lattices. Throws Interrupted.
template <int D>
State<D> start_state(const Scene& scene, std::uint64_t seed, const StopRequest& stop = {});

}  // namespace clatter
