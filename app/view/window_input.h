#pragma once

#include <string>
#include <vector>

struct GLFWwindow;

namespace clatter {

/// A key press with its modifiers.
struct KeyPress {
  int key = 0;  ///< GLFW key code
  bool shift = false;
  bool ctrl = false;

  /// Lower-case letter of the key in the current keyboard layout; 0: no letter.
  char letter() const;
};

/// Key presses and dropped files of a window. Dear ImGui samples the state of the keys once per
/// frame, and so misses a key that was released before.
class WindowInput {
 public:
  /// Installs the callbacks of the window. Must precede the set-up of Dear ImGui, whose callbacks
  /// call these.
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
