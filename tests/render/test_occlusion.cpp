#include <doctest/doctest.h>

#include <cmath>

#include "render/occlusion.h"

namespace clatter {

TEST_CASE("Occlusion: a disk hides what lies behind it, and nothing beside it") {
  Occlusion occlusion({100, 80}, 12.0);
  occlusion.cover({50.0, 40.0}, 20.0);
  CHECK(occlusion.hides({42.0, 32.0}, {58.0, 48.0}));
  CHECK(occlusion.hides({55.0, 41.0}, {61.0, 47.0}));
  CHECK_FALSE(occlusion.hides({34.0, 24.0}, {66.0, 56.0}));  // its corners are 22.6 from the centre
  CHECK_FALSE(occlusion.hides({69.0, 37.0}, {75.0, 43.0}));
  CHECK_FALSE(occlusion.hides({1.0, 1.0}, {7.0, 7.0}));
  // No pixel that counts as hidden lies outside of the disk.
  for (double x = 0.5; x < 100.0; ++x) {
    for (double y = 0.5; y < 80.0; ++y) {
      if (!occlusion.hides({x, y}, {x, y})) continue;
      CHECK(std::hypot(x - 50.0, y - 40.0) < 20.0);
    }
  }
}

}  // namespace clatter
