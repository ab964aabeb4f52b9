#include "render/context/context.h"

#include "engine/error.h"
#include "render/context/egl_context.h"
#include "render/context/glfw_context.h"
#include "render/context/osmesa_context.h"

namespace clatter {

namespace {

std::unique_ptr<GlContext> open_hidden_window() {
  try {
    return std::make_unique<GlfwContext>();
  } catch (const RunError& error) {
    throw RunError(error.what() + std::string("; use egl or osmesa, which need no display"));
  }
}

// EGL first: it uses a GPU if there is one, and is no slower than OSMesa otherwise.
std::unique_ptr<GlContext> open_first_that_works() {
  std::string reasons;
  for (Backend backend : {Backend::Egl, Backend::Osmesa}) {
    try {
      return open_context(backend);
    } catch (const RunError& error) {
      reasons += std::string("\n  ") + error.what();
    }
  }
  throw RunError("cannot draw on this machine:" + reasons);
}

}  // namespace

const char* name_of(Backend backend) {
  switch (backend) {
    case Backend::Auto:
      return "auto";
    case Backend::Egl:
      return "egl";
    case Backend::Osmesa:
      return "osmesa";
    case Backend::Glfw:
      return "glfw";
  }
  return "";
}

std::string GlContext::description() const {
  auto text = [this](GLenum name) { return reinterpret_cast<const char*>(gl_.GetString(name)); };
  return std::string(text(GL_RENDERER)) + ", OpenGL " + text(GL_VERSION);
}

std::unique_ptr<GlContext> open_context(Backend backend) {
  switch (backend) {
    case Backend::Auto:
      return open_first_that_works();
    case Backend::Egl:
      return std::make_unique<EglContext>();
    case Backend::Osmesa:
      return std::make_unique<OsmesaContext>();
    case Backend::Glfw:
      return open_hidden_window();
  }
  return nullptr;
}

}  // namespace clatter
