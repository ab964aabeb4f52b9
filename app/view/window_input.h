#pragma once

#include <string>
#include <vector>

namespace clatter {

/// A key press with its modifiers.
struct KeyPress {
  int key = 0;      ///< GLFW key code
  char letter = 0;  ///< lower-case letter of the key in the current keyboard layout; 0: no letter
  bool shift = false;
  bool ctrl = false;
};

/// Whether a key presses again while it is held down: the keys that step in time.
bool repeats(int key);

/// Key presses and dropped files of a window. Dear ImGui samples the state of the keys once per
/// frame, and so misses a key that was released before.
class WindowInput {
 public:
  /// Adds a key press.
  void press(const KeyPress& press) { presses_.push_back(press); }
  /// Adds a dropped file.
  void drop(const std::string& path) { dropped_.push_back(path); }
  /// The keys pressed since the last call of take_presses.
  const std::vector<KeyPress>& presses() const { return presses_; }
  /// The keys pressed since the last call, in order.
  std::vector<KeyPress> take_presses();
  /// The files dropped since the last call.
  std::vector<std::string> take_dropped();

 private:
  std::vector<KeyPress> presses_;
  std::vector<std::string> dropped_;
};

}  // namespace clatter
