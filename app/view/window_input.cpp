#include "app/view/window_input.h"

#include <utility>

namespace clatter {

std::vector<KeyPress> WindowInput::take_presses() {
  return std::exchange(presses_, {});
}

std::vector<std::string> WindowInput::take_dropped() {
  return std::exchange(dropped_, {});
}

}  // namespace clatter
