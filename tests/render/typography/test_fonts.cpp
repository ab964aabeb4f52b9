#include <doctest/doctest.h>

#include "render/context/context.h"
#include "render/typography/fonts.h"
#include "render/typography/gui_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

// The share of the area of a picture, in squares of the letters' size, that a text covers.
double ink(const Gl& gl, float unit) {
  constexpr Colour kBlack{0, 0, 0, 255}, kWhite{255, 255, 255, 255};
  Fonts fonts;
  const auto height = static_cast<int>(2.0f * unit);
  const Image image = gui_picture(
      gl, {3 * height, height}, kBlack,
      [&](ImFontAtlas& atlas) { fonts = add_fonts(atlas, unit, "Gas"); },
      [&](ImDrawList& list) {
        draw_text(list, fonts.text, {0.1f * unit, 0.1f * unit}, {kWhite, kWhite},
                  "Gas \u03c1\u00b2");
      });
  double sum = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 3 * height; ++x) sum += pixel(image, x, y).red / 255.0;
  }
  return sum / (unit * unit);
}

}  // namespace

// Pictures of 16384 pixels have letters of 410.
TEST_CASE("Fonts: the letters of the largest pictures are those of small ones") {
  const auto context = open_context(Backend::Auto);
  const double usual = ink(context->gl(), 100.0f);
  REQUIRE(usual > 0.3);
  for (const float unit : {60.0f, 70.0f, 160.0f, 161.0f, 250.0f, 410.0f}) {
    CAPTURE(unit);
    CHECK(ink(context->gl(), unit) == doctest::Approx(usual).epsilon(0.06));
  }
}

}  // namespace clatter
