#include "app/view/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace clatter {

bool repeats(int key) {
  return key == GLFW_KEY_PERIOD || key == GLFW_KEY_COMMA || key == GLFW_KEY_LEFT ||
         key == GLFW_KEY_RIGHT;
}

std::optional<std::array<float, 2>> WindowInput::take_mouse_press() {
  return std::exchange(mouse_press_, std::nullopt);
}

std::vector<KeyPress> WindowInput::take_presses() {
  return std::exchange(presses_, {});
}

std::vector<std::string> WindowInput::take_dropped() {
  return std::exchange(dropped_, {});
}

}  // namespace clatter
