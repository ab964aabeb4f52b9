#include "app/view/desktop.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>

namespace clatter {

// The letter, comma or period of a key in the current keyboard layout; 0: another sign. Alphabets
// without such letters have those of a US keyboard.
static char sign_of(int key) {
  if (key > GLFW_KEY_WORLD_2) return 0;
  const char* name = glfwGetKeyName(key, 0);
  const bool on_us = key >= GLFW_KEY_A && key <= GLFW_KEY_Z;
  const int sign = name && !name[1] ? name[0] : on_us ? key : 0;
  return std::isalpha(sign) || sign == ',' || sign == '.' ? static_cast<char>(std::tolower(sign))
                                                          : 0;
}

Desktop::Desktop(GLFWwindow* window, WindowInput& input) : window_(window) {
  glfwSetWindowUserPointer(window, &input);
  glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int, int action, int held) {
    if (action == GLFW_RELEASE || key == GLFW_KEY_UNKNOWN) return;
    const KeyPress press{key, sign_of(key), (held & GLFW_MOD_SHIFT) != 0,
                         (held & GLFW_MOD_CONTROL) != 0};
    if (action == GLFW_REPEAT && !repeats(press)) return;
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->press(press);
  });
  glfwSetCharCallback(window, [](GLFWwindow* of, unsigned character) {
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->type(character);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* of, double x, double y) {
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->move_mouse(x, y);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* of, int, int action, int) {
    if (action != GLFW_PRESS) return;
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->press_mouse();
  });
  glfwSetDropCallback(window, [](GLFWwindow* of, int count, const char** paths) {
    auto* to = static_cast<WindowInput*>(glfwGetWindowUserPointer(of));
    for (int k = 0; k < count; ++k) to->drop(paths[k]);
  });
}

float Desktop::content_scale() const {
  float scale = 1.0f;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  return scale;
}

void Desktop::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Desktop::copy(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void Desktop::toggle_full_screen() {
  auto& [x, y, width, height] = windowed_;
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, x, y, width, height, 0);
    return;
  }
  glfwGetWindowPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Desktop::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

}  // namespace clatter
