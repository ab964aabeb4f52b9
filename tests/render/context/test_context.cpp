#include <doctest/doctest.h>

#include "engine/error.h"
#include "render/context/context.h"
#include "render/renderer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

Image picture_of(const Gl& gl) {
  const Snapshot snapshot = driven_box();
  const Size size{640, 360};
  View view;
  view.field = Quantity::Density;
  const OverlayText text{"Title", "Caption"};
  Renderer renderer(gl);
  const Canvas canvas(gl, size);
  canvas.bind();
  renderer.draw(snapshot, renderer.fit(snapshot, size, view, text), size, view, text);
  return canvas.read();
}

}  // namespace

TEST_CASE("OSMesa opens OpenGL 3.3 core, again and again") {
  for (int i = 0; i < 3; ++i) {
    const auto context = open_context(Backend::Osmesa);
    CHECK(std::string(context->name()) == "osmesa");
    GLint major = 0, minor = 0;
    context->gl().GetIntegerv(GL_MAJOR_VERSION, &major);
    context->gl().GetIntegerv(GL_MINOR_VERSION, &minor);
    CHECK(10 * major + minor >= 33);
    CHECK(context->description().find("OpenGL") != std::string::npos);
  }
}

TEST_CASE("Auto opens what works") {
  CHECK_NOTHROW(open_context(Backend::Auto)->gl());
}

TEST_CASE("EGL and OSMesa draw the same picture") {
  auto draw_with = [](Backend backend) { return picture_of(open_context(backend)->gl()); };
  const Image osmesa = draw_with(Backend::Osmesa);
  Image egl;
  try {
    egl = draw_with(Backend::Egl);
  } catch (const RunError& error) {
    MESSAGE("no EGL here: " << error.what());
    return;
  }
  // A GPU may round an edge differently; a shape one pixel off would differ by far more.
  int different = 0;
  for (std::size_t i = 0; i < egl.rgba.size(); ++i) {
    if (std::abs(egl.rgba[i] - osmesa.rgba[i]) > 8) ++different;
  }
  CHECK(different < 1e-3 * egl.rgba.size());
}

TEST_CASE("Missing functions of OpenGL are named") {
  auto nothing = [](const char*) -> void* { return nullptr; };
  CHECK_THROWS_WITH_AS(load_gl(nothing), doctest::Contains("glDrawArrays"), RunError);
}

}  // namespace clatter
