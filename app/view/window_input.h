#pragma once

#include <string>
#include <vector>

struct GLFWwindow;

namespace clatter {

/// A key that was pressed, and what was held down with it.
struct KeyPress {
  int key = 0;  ///< as GLFW calls it
  bool shift = false;
  bool ctrl = false;

  /// The letter that it types on this keyboard, in lower case; 0 where it types none.
  char letter() const;
};

/// What was typed into a window and dropped on it since the last look. Dear ImGui knows only which
/// keys are down when it looks, and so misses a key that is let go before.
class WindowInput {
 public:
  /// Listens to a window; before Dear ImGui does, which passes on what it hears.
  explicit WindowInput(GLFWwindow* window);
  WindowInput(const WindowInput&) = delete;
  WindowInput& operator=(const WindowInput&) = delete;

  /// The keys pressed since the last call, in order.
  std::vector<KeyPress> take_presses();
  /// The files dropped since the last call.
  std::vector<std::string> take_dropped();

 private:
  std::vector<KeyPress> presses_;
  std::vector<std::string> dropped_;
};

}  // namespace clatter
