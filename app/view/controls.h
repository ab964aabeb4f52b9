#pragma once

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/session.h"

namespace clatter {

/// Widgets in its life react to presses over the height of usual ones, though they are smaller.
class Reach {
 public:
  /// For widgets `height` pixels high.
  explicit Reach(float height, float usual = ImGui::GetFrameHeight()) {
    ImGui::GetStyle().TouchExtraPadding.y = std::max(0.0f, 0.5f * (usual - height));
  }
  Reach(const Reach&) = delete;
  Reach& operator=(const Reach&) = delete;
  ~Reach() { ImGui::GetStyle().TouchExtraPadding.y = 0.0f; }
};

/// Description of a slider: key, texts and range.
struct Slider {
  const char* key = "";         ///< key of the scene file
  const char* name = "";        ///< label in the panel
  const char* symbol = "";      ///< symbol of docs/theory.md; empty: none
  const char* unit = "";        ///< unit after the value; empty: dimensionless
  const char* help = "";        ///< text of the tooltip
  double low = 0.0;             ///< smallest value
  double high = 1.0;            ///< largest value
  bool logarithmic = false;     ///< logarithmic scale
  const char* format = "%.3f";  ///< printf format of the value
  const char* limit = "";       ///< why no larger or smaller value is taken; empty: no reason
};

/// The widgets of the panels. Dragging a slider changes a moving gas a few times per second, and a
/// halted gas when it is released. Releasing it adds one entry to the undo history. A click on a
/// slider changes nothing. A click on its number, a double click or Ctrl and a click open a text
/// field. A typed number outside the range becomes the end of the range, with a message.
class Controls {
 public:
  Controls(Session& session, ScriptLog& log) : session_(session), log_(log) {}

  /// Draws only the controls with these names from now on, without headings.
  void choose(std::vector<std::string> names) { chosen_ = std::move(names); }
  /// Whether only chosen controls are drawn.
  bool chooses() const { return chosen_.has_value(); }
  /// Whether the control with this name is drawn.
  bool shows(const std::string& name);
  /// The names of the sliders since the last call, drawn or not.
  std::vector<std::string> take_sliders() { return std::exchange(sliders_, {}); }
  /// The chosen names without a control since the last call, with the nearest name of a control.
  std::vector<std::pair<std::string, std::string>> take_missing();
  /// Reports the names of take_missing(), unless the newest frame is of the run `checked`.
  void report_missing(std::uint64_t checked);

  /// Collapsible heading of a group in a panel. Returns true if the group is open.
  bool group(const char* name);
  /// Row of buttons that open groups of a panel and scroll to them.
  void group_row(std::initializer_list<const char*> names);
  /// Slider for a law. `value` is the current value, `usual` the value of the opened scene.
  void law(const Slider& slider, double value, double usual);
  /// Slider for an integer. The value is set when the slider is released, and restarts the gas.
  void whole(const Slider& slider, int value, int usual);
  /// Slider for a number of the start. The value is set when the slider is released, and restarts
  /// the gas.
  void of_start(const Slider& slider, double value, double usual);
  /// Slider for one component of a vector. Without `at_once` the value is set when the slider is
  /// released.
  void component(const Slider& slider, const VecX& vector, int axis, const VecX& usual,
                 bool at_once = true);
  /// Slider for a setting of the window. Returns true if the value changed.
  bool number(const Slider& slider, double& value, double usual);
  /// List of words. An arrow resets `chosen` to `usual`; both are indices into `words`. In a long
  /// list, `grouped`, lines separate words of another first word. Returns true if the choice
  /// changed.
  bool choice(const char* key, const char* name, const char* help,
              const std::vector<std::string>& words, int& chosen, int usual, bool grouped = false);
  /// Gives up the number that is being typed. Not all versions of Dear ImGui restore it.
  void cancel_typing() { cancelled_ = true; }
  /// Closes the open list of a choice. Returns whether there is one.
  bool close_list();
  /// Two text fields for the ends of a range. Returns true if a new pair with ends[0] < ends[1] was
  /// entered.
  bool ends(const char* key, const char* help, std::array<double, 2>& ends);
  /// Text field for a number, with its name at the left. Returns true if the number changed.
  bool entry(const char* key, const char* name, const char* help, double& value);
  /// Text field for up to 255 bytes, as above. A click selects the text.
  bool entry(const char* key, const char* name, const char* help, std::string& text);
  /// Check box. Returns true if it was clicked.
  bool toggle(const char* key, const char* name, const char* help, bool& on);
  /// Button of `width` pixels; 0: as wide as its label. It is marked while it is `on`. Returns true
  /// if it was pressed.
  bool button(const char* key, const char* label, const char* help, float width = 0.0f,
              bool on = false);

  /// Clickable area of full width and `height` pixels; the caller draws its content. Returns true
  /// if it was clicked.
  bool card(const char* key, float height, bool selected);
  /// Faint text, wrapped at the width of the window.
  void note(const char* key, const std::string& text);
  /// Area without content, with a tooltip. Returns true if the caller has to draw its content.
  bool area(const char* key, float width, float height, const std::string& help);

  /// Sets the view if it has `changed`. All changes up to the end of a drag are one undo entry.
  /// Call it in every frame.
  void show(const View& view, bool changed);
  /// Sets keys as one undo entry. If the box changes, `shift` moves its particles.
  void set(const std::vector<Override>& before, const std::vector<Override>& after,
           const VecX& shift = {});

 private:
  friend class ChosenControls;

  struct Moved {
    bool changed = false;  // the value changed since the last frame
    bool taken = false;    // a drag began
    bool let_go = false;   // a drag or the typing of a number ended
    bool reset = false;    // the reset arrow was clicked
  };

  Moved draw(const Slider& slider, double& value, double usual, const std::string& place);
  template <class Number>
  void restart(const Slider& slider, Number value, Number usual);
  template <class Field>
  bool named_field(const char* key, const char* name, const char* help, const Field& field);
  double limited(const Slider& slider, double value);
  void refuse_letters(const char* name);
  bool due();
  bool explains();
  void explain(const Slider& slider, double usual);
  void log_place(const std::string& key);

  Session& session_;
  ScriptLog& log_;
  std::optional<std::vector<std::string>> chosen_;  // absent: all controls are drawn
  std::vector<std::string> sliders_;                // names since the last take_sliders()
  std::string revealed_;                   // group that the next group() opens and scrolls to
  std::vector<std::string> offered_;       // names asked of shows() since the last take_missing()
  double before_ = 0.0;                    // value at the start of the current drag
  std::optional<double> typed_;            // number in the open text field, if it was edited
  bool cancelled_ = false;                 // whether the number in the open text field was given up
  std::array<double, 2> typed_ends_ = {};  // numbers of the last edited pair of text fields
  double held_ = 0.0;                      // pending value of the slider that is dragged
  std::string holding_;                    // name of that slider; empty: none
  double set_at_ = 0.0;                    // time of the last change by a drag, seconds
  bool closes_list_ = false;               // whether the open list shall close
  std::optional<View> shown_before_;       // view before the current drag
  std::uint64_t messages_ = 0;             // of the session so far
  ImVec2 told_at_ = {-FLT_MAX, -FLT_MAX};  // of the mouse at the last message
};

/// Only the controls with the given names are drawn in its life, without headings.
class ChosenControls {
 public:
  ChosenControls(Controls& controls, std::vector<std::string> names)
      : controls_(controls), former_(std::exchange(controls.chosen_, std::move(names))) {
    controls_.offered_.clear();
    controls_.sliders_.clear();
  }
  ChosenControls(const ChosenControls&) = delete;
  ChosenControls& operator=(const ChosenControls&) = delete;
  ~ChosenControls() { controls_.chosen_ = std::move(former_); }

 private:
  Controls& controls_;
  std::optional<std::vector<std::string>> former_;
};

}  // namespace clatter
