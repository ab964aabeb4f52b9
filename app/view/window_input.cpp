#include "app/view/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace clatter {

bool repeats(const KeyPress& press) {
  return press.key == GLFW_KEY_LEFT || press.key == GLFW_KEY_RIGHT || press.sign == ',' ||
         press.sign == '.';
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
