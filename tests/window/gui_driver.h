#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/shell.h"

namespace clatter {

/// A virtual display with the program in a window, and a driver of its mouse and keys. The program
/// writes its state to the script log.
class GuiDriver {
 public:
  /// Opens `clatter view` with these arguments in a window of this size, on a screen of the same
  /// size or of `screen`. Waits until the gas and all widgets are drawn.
  explicit GuiDriver(const std::string& arguments, const std::string& size = "1280x800",
                     const std::string& screen = "");

  /// Runs a shell line on the display.
  Outcome run(const std::string& line) const;
  /// Runs a line of xdotool.
  void tool(const std::string& line) const;
  /// Runs a line of xdotool, and waits until the program has drawn pictures with its effect.
  void act(const std::string& line) const;
  /// Presses and releases keys with these xdotool names, one after the other.
  void key(const std::string& names) const;
  /// Moves the mouse to this share of the width of a widget.
  void point_at(const std::string& widget, double share = 0.5) const;
  void click(const std::string& widget) const;
  /// Drags the grip of a slider from one share of its width to another, in steps.
  void drag(const std::string& widget, double from, double to) const;
  /// Drags a widget by this number of pixels.
  void pull(const std::string& widget, int right, int down) const;

  /// The newest event of a name for which `is_it` holds, without the first `after` events. Waits
  /// for it for some seconds, then fails.
  nlohmann::json wait_for(
      const std::string& event, std::size_t after = 0,
      const std::function<bool(const nlohmann::json&)>& is_it = [](auto&) { return true; }) const;
  /// Rectangle of a widget, once it stands still: left, top, width, height. Its newest move is not
  /// one of the first `after` events.
  std::vector<double> place(const std::string& widget, std::size_t after = 0) const;
  /// The events in the log, or the events of one name.
  std::vector<nlohmann::json> events(const std::string& name = "") const;
  /// The number of events in the log.
  std::size_t told() const { return events().size(); }
  /// The colour of a screen pixel: red, green, blue.
  std::vector<int> pixel(int x, int y) const;
  /// Whether the upper left corner of the viewport gets a colour within some pictures: the log is
  /// ahead of the screen by a picture.
  bool corner_becomes(const std::vector<int>& colour) const;
  /// The exit code of the program; -1 if it has not ended within some seconds.
  int exit_code() const;
  const Shell& shell() const { return shell_; }

 private:
  /// Closes the screen and its program, also after a failed construction of the driver.
  struct Screen {
    const Shell& shell;
    ~Screen() { shell.run("kill $(cat xvfb)"); }
  };

  Shell shell_;
  Screen screen_{shell_};
  std::string display_;
};

/// Whether a status event is that of a halted gas.
inline bool halted(const nlohmann::json& status) {
  return !status["plays"] && status.contains("hash");
}

/// The hash of a run of a scene without a window, at the time of a status event.
nlohmann::json hash_of_run(const GuiDriver& driver, const std::string& scene,
                           const nlohmann::json& status);

/// Saves the scene of a halted gas, and checks that a run of it has the same bits.
void check_saved_scene(const GuiDriver& driver);

}  // namespace clatter
