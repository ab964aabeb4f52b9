#include <doctest/doctest.h>

#include "engine/error.h"
#include "render/gl/canvas.h"
#include "tests/render/picture.h"

namespace clatter {

TEST_CASE("Canvas: a canvas has the size asked for, and its first row is the top one") {
  const auto context = open_context(Backend::Auto);
  const Gl& gl = context->gl();
  const Canvas canvas = blank_canvas(gl, {7, 5});
  gl.Enable(GL_SCISSOR_TEST);
  gl.Scissor(2, 4, 1, 1);  // from the lower left corner
  gl.ClearColor(1, 0, 0, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.Disable(GL_SCISSOR_TEST);
  const Image image = canvas.read();
  CHECK(image.size.width == 7);
  CHECK(image.size.height == 5);
  CHECK(image.rgba.size() == 7 * 5 * 4);
  CHECK(pixel(image, 2, 0) == Colour{255, 0, 0});
  CHECK(pixel(image, 2, 4) == kDarkTheme.background);
}

TEST_CASE("Canvas: a canvas larger than OpenGL allows is refused") {
  const auto context = open_context(Backend::Auto);
  CHECK_THROWS_WITH_AS(Canvas(context->gl(), {1 << 20, 10}), doctest::Contains("too large"),
                       RunError);
}

}  // namespace clatter
