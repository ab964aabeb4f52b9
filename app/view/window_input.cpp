#include "app/view/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>
#include <utility>

namespace clatter {

char KeyPress::letter() const {
  if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return 0;
  const char* name = glfwGetKeyName(key, 0);
  const int letter = name && !name[1] ? name[0] : key;
  return static_cast<char>(std::tolower(letter));
}

WindowInput::WindowInput(GLFWwindow* window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int, int action, int held) {
    if (action == GLFW_RELEASE) return;
    // Only the step keys repeat while held down.
    if (action == GLFW_REPEAT && key != GLFW_KEY_PERIOD) return;
    static_cast<WindowInput*>(glfwGetWindowUserPointer(of))
        ->presses_.push_back({key, (held & GLFW_MOD_SHIFT) != 0, (held & GLFW_MOD_CONTROL) != 0});
  });
  glfwSetDropCallback(window, [](GLFWwindow* of, int count, const char** paths) {
    auto& dropped = static_cast<WindowInput*>(glfwGetWindowUserPointer(of))->dropped_;
    dropped.insert(dropped.end(), paths, paths + count);
  });
}

std::vector<KeyPress> WindowInput::take_presses() {
  return std::exchange(presses_, {});
}

std::vector<std::string> WindowInput::take_dropped() {
  return std::exchange(dropped_, {});
}

}  // namespace clatter
