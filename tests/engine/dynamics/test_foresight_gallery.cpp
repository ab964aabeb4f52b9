// Every scene of the gallery, enlarged to many particles, has the same bits in tiles.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/dimension.h"
#include "engine/dynamics/foresight.h"
#include "engine/dynamics/simulation.h"
#include "engine/embedded_file.h"
#include "engine/error.h"
#include "engine/initial/start_state.h"
#include "engine/physics/random.h"
#include "engine/scene/scene_file.h"

using namespace clatter;

namespace {

constexpr std::uint64_t kGallerySeed = 24;
constexpr int kEnlargedCount = 200'000;

// The scene with more particles in a box that is larger by one factor along all axes. Gravity is
// weaker by this factor, so that the density has the same profile.
Scene enlarged(Scene scene) {
  const double factor = std::pow(static_cast<double>(kEnlargedCount) / scene.particles.count,
                                 1.0 / scene.dimension());
  scene.particles.count = kEnlargedCount;
  scene.box *= factor;
  if (scene.gravity) *scene.gravity /= factor;
  return scene;
}

// The hash of the state at every half collision per particle, or up to a physical stop.
template <int D>
std::vector<std::uint64_t> hashes_of(Simulation<D>& simulation) {
  constexpr int kHalts = 40;
  std::vector<std::uint64_t> hashes;
  try {
    for (int k = 1; k <= kHalts; ++k) {
      simulation.run_until(kNever, simulation.counts().collisions() + kEnlargedCount / 4);
      hashes.push_back(simulation.state_hash());
    }
  } catch (const PhysicalStop&) {
    hashes.push_back(simulation.state_hash());
  }
  CHECK(simulation.deepest_overlap() < 1e-11);
  return hashes;
}

// Returns the number of tiles that ran again.
template <int D>
std::uint64_t compare_threads(const Scene& scene, Random& random) {
  const Model<D> model = model_of<D>(scene, kGallerySeed);
  const State<D> start = start_state<D>(scene, kGallerySeed);
  Simulation<D> whole(model, start);
  const std::vector<std::uint64_t> wanted = hashes_of(whole);
  std::uint64_t redone = 0;
  for (const int threads : {1, 2, 3, 8}) {
    CAPTURE(threads);
    const bool usual = threads == 2;
    TileSizes sizes = tile_sizes(start.positions.size(), scene.packing_fraction(), threads);
    if (!usual) {
      sizes = {.particles = 2'000.0 + 10'000.0 * random.uniform(),
               .collisions = 0.5 + 2.0 * random.uniform(),
               .halo = 1.0 + 3.0 * random.uniform()};
    }
    Simulation<D> tiled(model, start);
    tiled.use_threads(threads, sizes);
    CHECK(hashes_of(tiled) == wanted);
    if (usual && !tiled.foresight()) continue;  // a box of spheres is too small for usual halos
    REQUIRE(tiled.foresight());
    const auto& work = tiled.foresight()->work();
    CHECK(work.windows > 0);
    redone += work.redone;
  }
  return redone;
}

}  // namespace

TEST_CASE("Foresight: every scene of the gallery with 200,000 particles has the same bits" *
          doctest::test_suite("slow")) {
  Random random(kGallerySeed, Stream::Kick, 1, 1);
  std::uint64_t redone = 0;
  for (const EmbeddedFile& file : embedded_scenes()) {
    CAPTURE(file.name);
    const Scene scene = load_gallery_scene(file);
    if (scene.particles.start.layout == Layout::File) continue;  // its particles are fixed
    redone += with_dimension(scene.dimension(), [&](auto dimension) {
      return compare_threads<dimension>(enlarged(scene), random);
    });
  }
  CHECK(redone > 2000);
}
