#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace clatter {

/// A key press with its modifiers.
struct KeyPress {
  int key = 0;    ///< GLFW key code, by its place on a US keyboard
  char sign = 0;  ///< lower-case letter, comma or period of the key in the keyboard layout, without
                  ///< Shift; 0: another sign
  bool shift = false;
  bool ctrl = false;
};

/// Whether a key presses again while it is held down: keys that step in time or in a list.
bool repeats(const KeyPress& press);

/// Keeps key presses, typed signs, presses of the mouse and dropped files of a window until its
/// next picture. Dear ImGui 1.86 samples keys and mouse once per picture, and so misses short
/// presses. Later versions spread them over several pictures.
class WindowInput {
 public:
  /// Adds a key press.
  void press(const KeyPress& press) { presses_.push_back(press); }
  /// Adds a typed character by its code point. Only signs of ASCII are shortcuts.
  void type(unsigned character) {
    if (character < 0x80) typed_ += static_cast<char>(character);
  }
  /// Adds a dropped file.
  void drop(const std::string& path) { dropped_.push_back(path); }
  /// Notes the place of the mouse, window units from the upper left corner.
  void move_mouse(double x, double y) { mouse_ = {static_cast<float>(x), static_cast<float>(y)}; }
  /// Notes that a mouse button is pressed at that place.
  void press_mouse() {
    if (!mouse_press_) mouse_press_ = mouse_;
  }
  /// The place of the first press of the mouse since the last call; absent: none.
  std::optional<std::array<float, 2>> take_mouse_press();
  /// The keys pressed since the last call of take_presses.
  const std::vector<KeyPress>& presses() const { return presses_; }
  /// The keys pressed since the last call, in order.
  std::vector<KeyPress> take_presses();
  /// The signs of ASCII typed since the last call, in order.
  std::string take_typed();
  /// The files dropped since the last call.
  std::vector<std::string> take_dropped();

 private:
  std::vector<KeyPress> presses_;
  std::string typed_;
  std::vector<std::string> dropped_;
  std::optional<std::array<float, 2>> mouse_;  // absent: not yet over the window
  std::optional<std::array<float, 2>> mouse_press_;
};

}  // namespace clatter
