#pragma once

#include <memory>
#include <string>

#include "render/camera.h"
#include "render/context/context.h"

struct GLFWwindow;

namespace clatter {

/// OpenGL in a window, or in a hidden one to draw off screen.
class GlfwContext final : public GlContext {
 public:
  /// A window of so many screen units, or hidden where it has no title. Throws RunError where there
  /// is no display, or none with OpenGL 3.3.
  explicit GlfwContext(const std::string& title = "", Size size = {1280, 720});
  ~GlfwContext() override;

  const char* name() const override { return "glfw"; }
  /// For GLFW's own functions.
  GLFWwindow* window() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace clatter
