#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/direction.h"
#include "app/view/gui.h"
#include "app/view/panels.h"

// The keyboard shortcuts of the window.

namespace clatter {

void Gui::use_keys() {
  for (const std::string& file : input_.take_dropped()) open_file(file);
  const std::string typed = input_.take_typed();
  for (const KeyPress& press : input_.take_presses()) {
    if (delayed_) {
      use_question_key(press);
      continue;
    }
    if (film_dialog_.is_open()) {
      if (press.key == GLFW_KEY_ESCAPE) film_dialog_.close();
      continue;
    }
    if (panels_.gallery) gallery_.press(press);
    use_function_key(press);
    if (!ImGui::GetIO().WantTextInput) use_key(press, typed);
  }
  if (!ImGui::GetIO().WantTextInput && !delayed_ && !film_dialog_.is_open()) use_signs(typed);
}

void Gui::use_question_key(const KeyPress& press) {
  if (press.key == GLFW_KEY_ENTER) typed_answer_ = Answer::Save;
  if (press.key == GLFW_KEY_ESCAPE) typed_answer_ = Answer::Cancel;
}

void Gui::use_function_key(const KeyPress& press) {
  switch (press.key) {
    case GLFW_KEY_ESCAPE:
      return close_something();
    case GLFW_KEY_F1:
      return panels_.toggle_help();
    case GLFW_KEY_F2:
      return screenshot();
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
  // Who types a name into the gallery before the search is active must not restart the gas.
  if (panels_.gallery && press.sign != 'g' && press.sign != 'h') return;
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
  if (panels_.lecture && use_lecture_key(press.sign)) return;
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
      return lecture(!panels_.lecture);
    case 'm':
      return fix_range();
    case 'n':
      return session_.select((session_.gas() + 1) % session_.gases());
    case 'p':
      if (panels_.lecture && !panels_.panels) {
        tools_.plot = !tools_.plot;
        return;
      }
      return panels_.toggle(Sheet::Plots);
    case 'r':
      return press.shift ? session_.restart_with_new_seed() : session_.restart();
    case 's':
      return listen(!session_.listens());
    case 't':
      return panels_.toggle(Sheet::Lesson);
    case 'v':
      return trace();
    default:
      return face_preset(press.sign);
  }
}

// The keys of the tools in lecture mode. Returns whether the key is one of them.
bool Gui::use_lecture_key(char key) {
  switch (key) {
    case 'd':
      toggle_pen();
      return true;
    case 'k':
      tools_.pointer = !tools_.pointer;
      return true;
    case 'w':
      press_stopwatch();
      return true;
    default:
      return false;
  }
}

void Gui::use_control_key(const KeyPress& press) {
  switch (press.sign) {
    case 'z':
      return press.shift ? session_.redo() : session_.undo();
    case 'y':
      return session_.redo();
    case 's':
      save_scenes();
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
    if (sign == '.' && !panels_.gallery) session_.step_frame();
    if (sign == ',' && !panels_.gallery) session_.step_frame_back();
    // Not every letter begins the search, so that G closes the gallery.
    if (sign == '/' && panels_.gallery) gallery_.search();
    if (sign == '[') step_scene(-1);
    if (sign == ']') step_scene(1);
    const auto tool = static_cast<std::size_t>(sign) - '1';
    if (tool < kTools.size() && !panels_.gallery && !controls_.chooses()) {
      toggle_tool(kTools[tool].tool);
    }
  }
}

void Gui::close_something() {
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return controls_.close_list();
  if (session_.frame().opening && session_.frame().run > 0) return session_.cancel_open();
  if (ImGui::GetIO().WantTextInput && !panels_.gallery) return controls_.cancel_typing();
  for (bool* open : {&panels_.gallery, &panels_.help, &tools_.settings}) {
    if (std::exchange(*open, false)) return;
  }
  if (mouse_tools_.tool()) return mouse_tools_.leave();
  if (std::exchange(panels_.plots, false)) return;
  if (panels_.narrow && panels_.sheet != Sheet::None) return panels_.toggle(panels_.sheet);
  if (panels_.lecture) return lecture(false);
  viewport_.let_go();
}

// Switches the colour range of the particles between automatic and a fixed range of round numbers.
void Gui::fix_range() {
  View view = session_.view();
  if (view.range.kind != ColourRange::Auto) {
    view.range = {};
  } else {
    const auto ends = colour_ends(session_.frame().snapshot, view.colour_by);
    if (ends[1] > 0.0) view.range = {ColourRange::Given, ends};
  }
  controls_.show(view, true);
}

// Makes the picked particle the tracer. Without another particle it ends the tracer.
void Gui::trace() {
  constexpr double kSeconds = 20.0;  // of playing
  View view = session_.view();
  const auto picked = viewport_.picked();
  const std::optional<Tracer> before = std::exchange(view.tracer, std::nullopt);
  if (picked && !(before && before->particle == static_cast<int>(*picked))) {
    view.tracer = Tracer{static_cast<int>(*picked), kSeconds * session_.frame().speed};
  }
  controls_.show(view, view.tracer != before);
}

// Spheres are seen from the direction with this key, if there is one.
void Gui::face_preset(char key) {
  const auto preset = std::ranges::find(kPresets, key, &Preset::key);
  if (preset == kPresets.end() || session_.scene().dimension() == 2) return;
  View view = session_.view();
  const bool changed = face(view, *preset);
  controls_.show(view, changed);
}

}  // namespace clatter
