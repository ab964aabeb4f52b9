#pragma once

#include <memory>
#include <string>

#include "render/camera.h"
#include "render/context/context.h"

struct GLFWwindow;

namespace clatter {

/// OpenGL in a window. A hidden window serves to draw off screen.
class GlfwContext final : public GlContext {
 public:
  /// Opens a window of `size` screen units; without a title the window is hidden. Throws RunError
  /// if there is no display or no OpenGL 3.3.
  explicit GlfwContext(const std::string& title = "", Size size = {1280, 720});
  ~GlfwContext() override;

  const char* name() const override { return "glfw"; }
  /// The window, for functions of GLFW.
  GLFWwindow* window() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace clatter
