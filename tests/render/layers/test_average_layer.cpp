#include <doctest/doctest.h>

#include "render/layers/average_layer.h"
#include "tests/render/picture.h"

namespace clatter {

TEST_CASE("Average layer: samples are averaged as linear light") {
  const auto context = open_context(Backend::Auto);
  const Gl& gl = context->gl();
  const Canvas fine = blank_canvas(gl, {6, 4});
  gl.Enable(GL_SCISSOR_TEST);
  gl.Scissor(2, 2, 1, 2);  // half of the pixel in the middle of the upper row
  gl.ClearColor(1, 1, 1, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.Scissor(3, 2, 1, 2);
  gl.ClearColor(0, 0, 0, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.Disable(GL_SCISSOR_TEST);
  const Canvas canvas = blank_canvas(gl, {3, 2});
  AverageLayer(gl).draw(fine, 2);
  const Image image = canvas.read();
  CHECK(difference(pixel(image, 1, 0), Colour{188, 188, 188}) <= 1);  // IEC 61966-2-1 of 1/2
  for (int y : {0, 1}) {
    for (int x : {0, 2}) CHECK(pixel(image, x, y) == kDarkTheme.background);
  }
}

}  // namespace clatter
