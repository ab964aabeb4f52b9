#include <doctest/doctest.h>

#include "render/palette.h"

namespace clatter {

TEST_CASE("Palette: a scale gives the map's ends at its ends and beyond, and mixes between") {
  const ColourScale scale{colour_map(Palette::Viridis), 2.0, 4.0};
  CHECK(scale(2.0) == Colour{0x44, 0x01, 0x54});
  CHECK(scale(4.0) == Colour{0xfd, 0xe7, 0x25});
  CHECK(scale(-9.0) == scale(2.0));
  CHECK(scale(9.0) == scale(4.0));
  // matplotlib's viridis at 0.5: (0.127568, 0.566949, 0.550556).
  CHECK(scale(3.0) == Colour{0x21, 0x90, 0x8c});
}

TEST_CASE("Palette: the bright end of a scale may stand for the lowest value") {
  const ColourScale scale{colour_map(Palette::Cividis), 0.0, -2.0};
  CHECK(scale(0.0) == Colour{0x00, 0x22, 0x4e});
  CHECK(scale(-2.0) == Colour{0xfe, 0xe8, 0x38});
  CHECK(scale(1.0) == scale(0.0));
  // matplotlib's cividis at 0.5: (0.488697, 0.485318, 0.471008).
  CHECK(scale(-1.0) == Colour{0x7c, 0x7b, 0x78});
}

TEST_CASE("Palette: zero keeps its colour between ends that differ") {
  const ColourScale scale{.map = diverging_map(), .low = -1.0, .high = 3.0, .about_zero = true};
  const ColourScale symmetric{diverging_map(), -3.0, 3.0};
  for (const double value : {-1.0, 0.0, 0.5, 3.0}) CHECK(scale(value) == symmetric(value));
  CHECK(scale(-2.0) == symmetric(-1.0));
}

TEST_CASE("Palette: the strength of a value is its share of the range") {
  const ColourMap map = colour_map(Palette::Viridis);
  const ColourScale rising{map, 2.0, 4.0}, falling{map, 0.0, -2.0};
  CHECK(rising.strength(1.0) == 0.0);
  CHECK(rising.strength(2.5) == 0.25);
  CHECK(rising.strength(9.0) == 1.0);
  CHECK(falling.strength(-0.5) == 0.25);
  const ColourScale scale{.map = diverging_map(), .low = -1.0, .high = 4.0, .about_zero = true};
  for (const double sign : {-1.0, 1.0}) CHECK(scale.strength(sign) == 0.25);
  CHECK(scale.strength(-3.0) == 0.25);  // the range ends at -1
  CHECK(scale.strength(0.0) == 0.0);
  CHECK(scale.strength(4.0) == 1.0);
}

TEST_CASE("Palette: zero is grey on the diverging map") {
  const Colour grey = ColourScale{diverging_map(), -1.0, 1.0}(0.0);
  CHECK(grey.red == grey.green);
  CHECK(grey.green == grey.blue);
}

}  // namespace clatter
