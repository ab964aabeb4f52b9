#include <doctest/doctest.h>

#include <cmath>

#include "render/occlusion.h"

namespace clatter {

TEST_CASE("Occlusion: a disk hides what lies behind it, and nothing beside it") {
  Occlusion occlusion({100, 80});
  occlusion.cover({50.0, 40.0}, 20.0);
  CHECK(occlusion.hides({50.0, 40.0}, 20.0));
  CHECK(occlusion.hides({58.0, 44.0}, 10.0));
  CHECK_FALSE(occlusion.hides({58.0, 46.0}, 12.0));
  CHECK_FALSE(occlusion.hides({72.0, 40.0}, 3.0));
  CHECK_FALSE(occlusion.hides({4.0, 4.0}, 3.0));
  // The covered pixels are those with their centre in the disk, in all words of the rows.
  for (double x = 0.5; x < 100.0; ++x) {
    for (double y = 0.5; y < 80.0; ++y) {
      CAPTURE(x);
      CAPTURE(y);
      CHECK(occlusion.hides({x, y}, 0.1) == (std::hypot(x - 50.0, y - 40.0) <= 20.0));
    }
  }
}

TEST_CASE("Occlusion: several disks hide another together") {
  Occlusion occlusion({300, 80});
  for (const double x : {128.0, 132.0}) {
    CHECK_FALSE(occlusion.hides({130.0, 40.0}, 5.0));
    occlusion.cover({x, 40.0}, 6.2);
  }
  CHECK(occlusion.hides({130.0, 40.0}, 5.0));
}

TEST_CASE("Occlusion: only the part of a disk in the picture counts") {
  Occlusion occlusion({64, 64});
  occlusion.cover({0.0, 64.0}, 10.0);
  CHECK(occlusion.hides({-2.0, 66.0}, 6.0));
  CHECK_FALSE(occlusion.hides({-2.0, 50.0}, 6.0));
  CHECK(occlusion.hides({-20.0, 80.0}, 10.0));
}

}  // namespace clatter
