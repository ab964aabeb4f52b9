#include "render/context/glfw_context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>

#include "engine/error.h"

namespace clatter {

static bool is_wayland() {
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  return wayland && *wayland;
}

static RunError failure(const char* what) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return RunError(std::string("glfw: ") + what + (reason ? std::string(", ") + reason : ""));
}

// GLFW 3.4 looks for a compositor of Wayland first, whose library complains on standard error if
// there is none.
static void prefer_named_display() {
#ifdef GLFW_PLATFORM_X11
  if (!is_wayland()) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
}

// Before 3.4 a library of GLFW is for X11 or for Wayland. Later it opens the libraries of both at
// run time.
static RunError no_display() {
  const RunError error = failure("no display");
  if (!is_wayland()) return error;
  int major = 0, minor = 0, revision = 0;
  glfwGetVersion(&major, &minor, &revision);
  const bool for_both = major > 3 || minor >= 4;
  return RunError(std::string(error.what()) + "; this is a Wayland session: install Xwayland, or " +
                  (for_both ? "the libraries libwayland-client0, libwayland-cursor0, "
                              "libwayland-egl1 and libxkbcommon0"
                            : "GLFW for Wayland (libglfw3-wayland) in place of libglfw3"));
}

GlfwContext::GlfwContext(const std::string& title, Size size) {
  prefer_named_display();
  if (!glfwInit()) throw no_display();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, title.empty() ? GLFW_FALSE : GLFW_TRUE);
  window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const RunError error = failure("no window with OpenGL 3.3");
    glfwTerminate();
    throw error;
  }
  glfwMakeContextCurrent(window_);
  try {
    gl_ = load_gl(
        [](const char* symbol) { return reinterpret_cast<void*>(glfwGetProcAddress(symbol)); });
  } catch (...) {
    glfwTerminate();
    throw;
  }
}

GlfwContext::~GlfwContext() {
  glfwTerminate();
}

}  // namespace clatter
