#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/shell.h"

namespace clatter {

/// A display without a screen, the program in a window on it, and the driver of its mouse and keys.
/// The program tells what it does in its script log.
class GuiDriver {
 public:
  /// Opens `clatter view` with these arguments on a screen of this size, and waits until it shows
  /// a gas and all that it shows has its place.
  explicit GuiDriver(const std::string& arguments, const std::string& size = "1280x800");

  /// Runs a line of the shell on the display.
  Outcome run(const std::string& line) const;
  /// Runs a line of xdotool.
  void tool(const std::string& line) const;
  /// Presses and lets go of a key, as xdotool calls it.
  void key(const std::string& name) const;
  /// Moves the mouse to a share of the way across a widget.
  void point_at(const std::string& widget, double share = 0.5) const;
  void click(const std::string& widget) const;
  /// Drags a slider's grip from one share of its width to another, in steps.
  void drag(const std::string& widget, double from, double to) const;
  /// Drags a widget by so many pixels.
  void pull(const std::string& widget, int right, int down) const;

  /// The newest event of a name after the `after` first events for which `is_it` holds; waits for
  /// it, for some seconds, and fails where it does not come.
  nlohmann::json wait_for(
      const std::string& event, std::size_t after = 0,
      const std::function<bool(const nlohmann::json&)>& is_it = [](auto&) { return true; }) const;
  /// The events logged so far, or those of one name.
  std::vector<nlohmann::json> events(const std::string& name = "") const;
  /// How many there are.
  std::size_t told() const { return events().size(); }
  /// The colour of a pixel of the screen: red, green, blue.
  std::vector<int> pixel(int x, int y) const;
  /// The mean over a widget's pixels of how much brighter they are than the darkest, 0..255.
  double brightness(const std::string& widget) const;
  /// The program's exit code, once it has ended; -1 where it has not within some seconds.
  int exit_code() const;
  const Shell& shell() const { return shell_; }

 private:
  /// Ends the screen and the program on it, also where the driver does not come about.
  struct Screen {
    const Shell& shell;
    ~Screen() { shell.run("kill $(cat xvfb)"); }
  };

  /// Place of a widget: left, top, width, height.
  std::vector<double> place(const std::string& widget) const;

  Shell shell_;
  Screen screen_{shell_};
  std::string display_;
};

}  // namespace clatter
