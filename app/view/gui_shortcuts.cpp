#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/gui.h"
#include "app/view/panels.h"
#include "app/view/viewport.h"

// The keyboard shortcuts of the window.

namespace clatter {

// Switches the colour range of the particles between automatic and a fixed range of round numbers.
static void fix_range(const Session& session, Controls& controls) {
  View view = session.view();
  if (view.range.kind != ColourRange::Auto) {
    view.range = {};
  } else {
    const auto ends = colour_ends(session.frame().snapshot, view.colour_by);
    if (ends[1] > 0.0) view.range = {ColourRange::Given, ends};
  }
  controls.show(view, true);
}

// Makes the picked particle the tracer. Without another particle it ends the tracer.
static void trace(const Session& session, Controls& controls,
                  const std::optional<std::size_t>& picked) {
  constexpr double kSeconds = 20.0;  // of playing
  View view = session.view();
  const std::optional<Tracer> before = std::exchange(view.tracer, std::nullopt);
  if (picked && !(before && before->particle == static_cast<int>(*picked))) {
    view.tracer = Tracer{static_cast<int>(*picked), kSeconds * session.frame().speed};
  }
  controls.show(view, view.tracer != before);
}

// Spheres are seen from the direction with this key, if there is one.
static void face_preset(const Session& session, Controls& controls, char key) {
  const auto preset = std::ranges::find(kPresets, key, &Preset::key);
  if (preset == kPresets.end() || session.scene().dimension() == 2) return;
  View view = session.view();
  const bool changed = face(view, *preset);
  controls.show(view, changed);
}

void Gui::use_keys() {
  for (const std::string& file : input_.take_dropped()) opener_.open_file(file);
  const std::string typed = input_.take_typed();
  const bool in_gallery = panels_.gallery;
  for (const KeyPress& press : input_.take_presses()) {
    if (opener_.asks()) {
      opener_.press(press);
      continue;
    }
    if (recorder_.has_dialog()) {
      if (press.key == GLFW_KEY_ESCAPE && !controls_.close_list()) recorder_.close_dialog();
      continue;
    }
    if (panels_.gallery) gallery_.press(press);
    use_function_key(press);
    if (!ImGui::GetIO().WantTextInput) use_key(press, typed);
  }
  if (ImGui::GetIO().WantTextInput || opener_.asks() || recorder_.has_dialog()) return;
  if (!panels_.gallery) return use_signs(typed);
  // The letter that opened the gallery is no part of the searched text.
  gallery_.type(in_gallery ? typed : typed.substr(typed.find_first_of("gG") + 1));
}

void Gui::use_function_key(const KeyPress& press) {
  switch (press.key) {
    case GLFW_KEY_ESCAPE:
      return close_something();
    case GLFW_KEY_F1:
      return panels_.toggle_help();
    case GLFW_KEY_F2:
      return recorder_.screenshot(lecture_.theme());
    case GLFW_KEY_F11:
      return host_.toggle_full_screen();
    default:
      return;
  }
}

// `typed` are all signs that are typed before the next picture.
void Gui::use_key(const KeyPress& press, const std::string& typed) {
  if (press.ctrl) return use_control_key(press);
  // An embedded gas has no other parts.
  const bool opens = press.key == GLFW_KEY_TAB ||
                     std::string_view("ghlpt").find(press.sign) != std::string_view::npos;
  if (controls_.chooses() && opens) return;
  // The gallery takes all letters as the searched text.
  if (panels_.gallery) return;
  switch (press.key) {
    case GLFW_KEY_TAB:
      return panels_.toggle_panels();
    case GLFW_KEY_SPACE:
      return session_.play(!session_.frame().plays);
    case GLFW_KEY_LEFT:
      return session_.skip(-1.0);
    case GLFW_KEY_RIGHT:
      return session_.skip(1.0);
    case GLFW_KEY_HOME:
      return session_.jump(0.0);
    case GLFW_KEY_END:
      return session_.go_to_head();
    default:
      break;
  }
  if (panels_.lecture && lecture_.use_key(press.sign)) return;
  switch (press.sign) {
    case '.':
    case ',':
      // In some layouts Shift and this key type the other sign.
      if (!press.shift || typed.find_first_of(",.") != std::string::npos) return;
      return press.sign == '.' ? session_.step_collision() : session_.step_collision_back();
    case 'b':
      return session_.frame().backwards ? session_.play(true) : session_.play_backwards();
    case 'c':
      return session_.add_copy();
    case 'f':
      return viewport_.fit();
    case 'g':
      return panels_.toggle_gallery();
    case 'h':
      return panels_.toggle_help();
    case 'l':
      return lecture_.toggle();
    case 'm':
      return fix_range(session_, controls_);
    case 'n':
      return session_.select((session_.gas() + 1) % session_.gases());
    case 'p':
      if (panels_.lecture && !panels_.panels) {
        return lecture_.toggle_plot();
      }
      return panels_.toggle(Sheet::Plots);
    case 'r':
      return press.shift ? session_.restart_with_new_seed() : session_.restart();
    case 's':
      return listen(!session_.listens());
    case 't':
      return panels_.toggle(Sheet::Lesson);
    case 'v':
      return trace(session_, controls_, viewport_.picked());
    default:
      return face_preset(session_, controls_, press.sign);
  }
}

void Gui::use_control_key(const KeyPress& press) {
  switch (press.sign) {
    case 'z':
      return press.shift ? session_.redo() : session_.undo();
    case 'y':
      return session_.redo();
    case 's':
      recorder_.save_scenes(lecture_.theme());
      return;
    case 'q':
      return host_.close();
    default:
      return;
  }
}

// Signs are read as characters, because their keys differ between keyboard layouts.
void Gui::use_signs(const std::string& typed) {
  for (const char sign : typed) {
    if (sign == '+' || sign == '=') session_.change_speed(true);
    if (sign == '-') session_.change_speed(false);
    if (sign == '.') session_.step_frame();
    if (sign == ',') session_.step_frame_back();
    if (sign == '[') opener_.step(-1);
    if (sign == ']') opener_.step(1);
    const auto tool = static_cast<std::size_t>(sign) - '1';
    if (tool < kTools.size() && !controls_.chooses()) {
      lecture_.toggle_tool(kTools[tool].tool);
    }
  }
}

void Gui::close_something() {
  if (controls_.close_list()) return;
  const Frame& frame = session_.frame();
  if ((frame.opening || frame.bound_for) && frame.run > 0) return session_.cancel_open();
  if (ImGui::GetIO().WantTextInput && !panels_.gallery) return controls_.cancel_typing();
  if (std::exchange(panels_.gallery, false) || std::exchange(panels_.help, false)) return;
  if (lecture_.close_settings()) return;
  if (mouse_tools_.tool()) return mouse_tools_.leave();
  if (std::exchange(panels_.plots, false)) return;
  if (panels_.narrow && panels_.sheet != Sheet::None) return panels_.toggle(panels_.sheet);
  if (panels_.lecture) return lecture_.toggle();
  viewport_.let_go();
}

}  // namespace clatter
