#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <vector>

#include "app/view/thumbnails.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/theme.h"

namespace clatter {

namespace {

// The colours of the thumbnail of a scene: red + 256 green + 65536 blue.
std::set<unsigned> colours_of(const Gl& gl, Thumbnails& thumbnails, const EmbeddedFile& scene) {
  GLuint texture = 0;
  for (int look = 0; look < 10'000 && texture == 0; ++look) {
    texture = thumbnails.of(scene);
    thumbnails.work(std::chrono::milliseconds(1));
  }
  REQUIRE(texture != 0);
  const auto [width, height] = Thumbnails::kSize;
  const Framebuffer framebuffer = generate<Framebuffer>(gl, gl.GenFramebuffers);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  std::vector<unsigned char> bytes(static_cast<std::size_t>(4 * width * height));
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  std::set<unsigned> colours;
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    colours.insert(bytes[i] + 256u * bytes[i + 1] + 65536u * bytes[i + 2]);
  }
  return colours;
}

unsigned ground() {
  const Colour colour = theme_of(View{}).background;
  return colour.red + 256u * colour.green + 65536u * colour.blue;
}

}  // namespace

// Shaded spheres have far more colours than flat disks of one colour.
TEST_CASE("Thumbnails: disks are flat, and spheres have light and shade") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  Thumbnails thumbnails(context->gl(), renderer);
  const EmbeddedFile spheres{"spheres.toml", R"(
box.size = [8.0, 8.0, 8.0]
particles.count = 50
view.colour_by = "none"
)"};
  const EmbeddedFile disks{"disks.toml", R"(
box.size = [8.0, 8.0]
particles.count = 20
view.colour_by = "none"
)"};
  const auto flat = colours_of(context->gl(), thumbnails, disks);
  const auto shaded = colours_of(context->gl(), thumbnails, spheres);
  CHECK(flat.size() > 2);
  CHECK(flat.contains(ground()));
  CHECK(shaded.size() > 2 * flat.size());
}

}  // namespace clatter
