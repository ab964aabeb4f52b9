#include "app/view/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace clatter {

bool repeats(const KeyPress& press) {
  switch (press.key) {
    case GLFW_KEY_LEFT:
    case GLFW_KEY_RIGHT:
    case GLFW_KEY_UP:
    case GLFW_KEY_DOWN:
      return true;
    default:
      return press.sign == ',' || press.sign == '.';
  }
}

std::optional<std::array<float, 2>> WindowInput::take_mouse_press() {
  return std::exchange(mouse_press_, std::nullopt);
}

std::vector<KeyPress> WindowInput::take_presses() {
  return std::exchange(presses_, {});
}

std::string WindowInput::take_typed() {
  return std::exchange(typed_, {});
}

std::vector<std::string> WindowInput::take_dropped() {
  return std::exchange(dropped_, {});
}

}  // namespace clatter
