#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/dynamics/particle.h"
#include "engine/physics/random.h"

using namespace clatter;

template <int D>
static void keep_images() {
  Random random(31, Stream::Placement, 0, 0);
  ParticleArray<D> particles(100);
  std::vector<Vec<D>> images(100, Vec<D>::Zero());
  std::vector<std::uint32_t> kinds(100);
  int far = 0;
  for (int step = 0; step < 20000; ++step) {
    const auto i = static_cast<std::uint32_t>(random.below(100));
    Vec<D> boxes;
    for (double& component : boxes) {
      component = std::floor(random.below(9) == 0 ? 40000.0 * random.uniform() - 20000.0
                                                  : 3.0 * random.uniform() - 1.0);
    }
    if (random.below(3) == 0) boxes = -images[i];
    images[i] += boxes;
    particles.move_image(i, boxes);
    REQUIRE(particles.image(i) == images[i]);
    REQUIRE(((particles[i].image & kImageMask) == 0) == images[i].isZero(0.0));
    REQUIRE(particles.kind(i) == kinds[i]);
    if (random.below(3) == 0) particles.set_kind(i, kinds[i] = random.below(128));
    far += particles[i].image < 0;
  }
  CHECK(far > 1000);
  CHECK(far < 19000);
}

TEST_CASE("ParticleArray: periodic images near and far are kept, and kinds beside them") {
  keep_images<2>();
  keep_images<3>();
}

TEST_CASE("ParticleArray: the largest image that fits its field, and the next one") {
  CHECK(packed_image<3>({127.0, -127.0, 0.0}) != kFarImage);
  CHECK(packed_image<3>({0.0, 0.0, 128.0}) == kFarImage);
  CHECK(packed_image<2>({-2047.0, 2047.0}) != kFarImage);
  CHECK(packed_image<2>({-2048.0, 0.0}) == kFarImage);
  CHECK(packed_image<2>({1e300, 0.0}) == kFarImage);
}
