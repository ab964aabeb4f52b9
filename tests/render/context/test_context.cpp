#include <doctest/doctest.h>

#include "engine/error.h"
#include "render/context/context.h"
#include "render/layers/renderer.h"
#include "tests/render/optional_context.h"
#include "tests/render/picture.h"
#include "tests/support/messages.h"

namespace clatter {

using testing::says;

TEST_CASE("Context: OSMesa opens OpenGL 3.3 core, again and again") {
  for (int i = 0; i < 3; ++i) {
    const auto context = open_or_skip(Backend::Osmesa);
    if (!context) return;
    CHECK(std::string(context->name()) == "osmesa");
    GLint major = 0, minor = 0;
    context->gl().GetIntegerv(GL_MAJOR_VERSION, &major);
    context->gl().GetIntegerv(GL_MINOR_VERSION, &minor);
    CHECK(10 * major + minor >= 33);
    CHECK(says(context->description(), "OpenGL"));
  }
}

TEST_CASE("Context: the error of a missing OSMesa names EGL") {
  try {
    open_context(Backend::Osmesa);
    MESSAGE("[skipped] OSMesa is installed");
  } catch (const RunError& error) {
    CHECK(says(error.what(), "--backend egl"));
  }
}

TEST_CASE("Context: missing functions of OpenGL are named") {
  auto nothing = [](const char*) -> void* { return nullptr; };
  CHECK_THROWS_WITH_AS(load_gl(nothing), doctest::Contains("glDrawArrays"), RunError);
}

}  // namespace clatter
