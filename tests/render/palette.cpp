#include "render/palette.h"

#include <doctest/doctest.h>

namespace clatter {

TEST_CASE("A scale gives the map's ends at its ends and beyond, and mixes between") {
  const ColourScale scale{colour_map(Palette::Viridis), 2.0, 4.0};
  CHECK(scale(2.0) == Colour{0x44, 0x01, 0x54});
  CHECK(scale(4.0) == Colour{0xfd, 0xe7, 0x25});
  CHECK(scale(-9.0) == scale(2.0));
  CHECK(scale(9.0) == scale(4.0));
  // matplotlib's viridis at 0.5: (0.127568, 0.566949, 0.550556).
  CHECK(scale(3.0) == Colour{0x21, 0x90, 0x8c});
}

TEST_CASE("Zero is grey on the diverging map") {
  const Colour grey = ColourScale{diverging_map(), -1.0, 1.0}(0.0);
  CHECK(grey.red == grey.green);
  CHECK(grey.green == grey.blue);
}

}  // namespace clatter
