#pragma once

#include <string>

#include "app/view/session.h"

namespace clatter {

/// A number that a slider sets.
struct Slider {
  const char* key = "";     ///< of the scene file
  const char* name = "";    ///< as the panel writes it
  const char* symbol = "";  ///< as in docs/theory.md
  const char* unit = "";    ///< behind the value; empty: a bare number
  const char* help = "";    ///< what it means
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;
  const char* format = "%.3f";
};

/// The sliders and switches of the panels. What is dragged acts at once on the gas, and is one
/// entry to take back once it is let go.
class Controls {
 public:
  Controls(Session& session, ScriptLog& log) : session_(session), log_(log) {}

  /// A slider for a law; `value` is the one in force, `usual` that of the scene as it was opened.
  void law(const Slider& slider, double value, double usual);
  /// A slider for a whole number, which is set when it is let go: the gas starts anew.
  void whole(const Slider& slider, int value, int usual);
  /// A slider for a component of a pair of numbers under one key.
  void component(const Slider& slider, const Vec2& pair, int axis, const Vec2& usual,
                 bool at_once = true);
  /// A slider for something of the window's own; whether it has changed.
  bool number(const Slider& slider, double& value, double usual);
  /// A list of words under a key of the window's own or of a law, with an arrow back to the `usual`
  /// one; whether another was chosen.
  bool choice(const char* key, const char* name, const char* help,
              const std::vector<std::string>& words, int& chosen, int usual);
  /// Two numbers to type, the second greater than the first; whether others were.
  bool ends(const char* key, const char* help, std::array<double, 2>& ends);
  /// A box to tick; whether it was.
  bool toggle(const char* key, const char* name, const char* help, bool& on);
  /// A button as wide as its label, or so many pixels; whether it was pressed.
  bool button(const char* key, const char* label, const char* help, float width = 0.0f);

  /// A wide area to click on, of so many pixels' height, for what is drawn over it.
  bool card(const char* key, float height);

  /// Draws otherwise where that has `changed`, to be taken back in one once nothing is dragged.
  void show(const View& view, bool changed);
  /// Sets keys, to be taken back in one; where that makes another box, its disks move by `shift`.
  void set(const std::vector<Override>& before, const std::vector<Override>& after,
           const Vec2& shift = Vec2::Zero());

 private:
  struct Moved {
    bool changed = false;  // since the last frame
    bool taken = false;    // the drag begins
    bool let_go = false;   // it ends with another value
    bool reset = false;    // the usual value is asked for
  };

  Moved draw(const Slider& slider, double& value, double usual);
  void log_place(const char* key);

  Session& session_;
  ScriptLog& log_;
  double before_ = 0.0;               // value when the drag under way began
  double held_ = 0.0;                 // of a slider that waits to be let go
  std::string holding_;               // its name
  std::optional<View> shown_before_;  // before the drag under way changed the view
};

/// A heading of a group in a panel; whether it is open.
bool group(const char* name);

}  // namespace clatter
