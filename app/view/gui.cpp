#include "app/view/gui.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/view/gui_keys.h"
#include "app/view/messages.h"
#include "app/view/panels.h"
#include "app/view/style.h"
#include "app/view/top_bar.h"
#include "engine/error.h"

namespace clatter {

static constexpr float kPanelWidth = 17.0f;   // usual width of a panel, in text sizes
static constexpr float kPanelShare = 0.175f;  // width of a panel over the width of the window
// A narrower window has sheets: this many text sizes and heights of buttons.
static constexpr float kNarrowText = 25.0f, kNarrowFrames = 14.0f;
static constexpr float kTextSize = 14.0f;  // usual size of the text, points

Gui::Gui(Host& host, const Gl& gl, WindowInput& input, EngineLink& engine, ScriptLog& log)
    : host_(host),
      gl_(&gl),
      input_(input),
      log_(log),
      session_(engine, log),
      controls_(session_, log),
      viewport_(gl),
      gallery_(gl, viewport_.renderer()),
      plots_(parts()),
      recorder_(parts()),
      opener_(parts(), gallery_, plots_, recorder_),
      lecture_(parts(), plots_, opener_),
      mouse_(parts(), lecture_),
      gui_(gl) {}

WindowParts Gui::parts() {
  return {host_, log_, session_, controls_, viewport_, mouse_tools_, text_scale_, panels_};
}

void Gui::listen(bool on) {
  Loudspeaker* loudspeaker = host_.loudspeaker();
  if (!loudspeaker) return;
  try {
    if (on) {
      loudspeaker->open();
    } else {
      loudspeaker->close();
    }
  } catch (const RunError& error) {
    return session_.report(error.what());
  }
  session_.listen(on);
}

// A loudspeaker that fails is closed.
void Gui::play_sound() {
  const std::string failure = host_.loudspeaker()->play(session_.frame().played);
  if (failure.empty()) return;
  listen(false);
  session_.report(failure);
}

// Reads the scale of the window and loads the fonts for it.
void Gui::begin() {
  const float size = std::round(letters() * kTextSize * host_.content_scale());
  if (size != fonts_.unit()) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    fonts_ = add_fonts(atlas, size);
    ImGui::GetIO().FontDefault = fonts_.text.face;
    gui_.upload(atlas);
  }
  constexpr float kTarget = 44.0f;  // points that a finger hits
  const float target = panels_.lecture ? kTarget * host_.content_scale() : 0.0f;
  apply_style(size, std::max(host_.least_target(), target), panel_theme(lecture_.shown_view()));
  scale_ = std::max(1.0f, ImGui::GetIO().DisplayFramebufferScale.x);
  begin_picture(input_.presses());
}

void Gui::draw() {
  begin();
  if (session_.update()) {
    // While a scene is being opened, the former gas stands still.
    if (!session_.frame().opening) viewport_.redraw();
    plots_.add(session_.frame());
  }
  if (title_ != session_.opened().title) {
    title_ = session_.opened().title;
    // Opens the plots with a scene that has some.
    if (!panels_.lecture && !controls_.chooses() && !session_.opened().view.plots.empty()) {
      panels_.plots = true;
    }
    host_.set_title(*title_ + " – clatter");
  }
  if (session_.listens()) play_sound();
  recorder_.update();
  use_keys();
  session_.show_profile(panels_.shows_plots()      ? profiled_by(plots_.profiled())
                        : lecture_.shows_profile() ? Profiled::Fields
                                                   : Profiled::Nothing,
                        plots_.profile_axis());
  panels();
  viewport();
  ImGui::Render();
  draw_picture();
  log_.event("picture", nlohmann::json::object());
}

// Draws the gas and the panels.
void Gui::draw_picture() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Gl& gl = *gl_;
  const Size size{static_cast<int>((area_.high.x - area_.low.x) * scale_),
                  static_cast<int>((area_.high.y - area_.low.y) * scale_)};
  if (size.width > 0 && size.height > 0 && session_.frame().scene) {
    if (std::exchange(drawn_views_, session_.views()) != session_.views()) viewport_.redraw();
    // Until the engine has opened a scene of another dimension, its view does not fit the frame.
    if (session_.scene().dimension() == session_.frame().scene->dimension()) {
      constexpr double kLeast = 0.8;  // smallest text of the picture, in text sizes of the panels
      // Lecture mode has title and caption in a strip of their own.
      const bool heading = !panels_.lecture || panels_.panels;
      viewport_.draw(session_.frame(), lecture_.shown_view(), size, letters(),
                     kLeast * fonts_.unit(), heading, plots_.titles());
    }
    viewport_.show(static_cast<int>(area_.low.x * scale_),
                   static_cast<int>((whole.y - area_.high.y) * scale_));
    recorder_.add_picture(static_cast<int>(area_.low.x * scale_),
                          static_cast<int>(area_.low.y * scale_), size);
  }
  gl.Viewport(0, 0, static_cast<int>(whole.x * scale_), static_cast<int>(whole.y * scale_));
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gui_.draw(*ImGui::GetDrawData());
}

void Gui::panels() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  area_ = {ImVec2(0, 0), whole};
  if (controls_.chooses()) return chosen_controls();
  if (panels_.lecture && !panels_.panels) return lecture_.draw(area_, timeline_);
  const float unit = ImGui::GetFontSize();
  panels_.narrow = whole.x < kNarrowText * unit + kNarrowFrames * ImGui::GetFrameHeight();
  if (panels_.narrow) return sheets();
  // The least width has room for the longest indented name and its number.
  const float width = std::round(
      std::clamp(kPanelShare * whole.x, 0.88f * kPanelWidth * unit, 1.3f * kPanelWidth * unit));
  if (panels_.panels) {
    area_.low.y = top_panel();
    left_panel(area_.low.y, width);
    area_.low.x = width;
  }
  if (panels_.plots && session_.frame().scene) {
    plots_drawer(area_.low.y, width);
    area_.high.x -= width;
  }
  // The gallery shows these texts itself.
  if (panels_.lesson && !panels_.gallery) {
    area_.high.y -= lesson_strip(session_.scene(), area_, controls_, panels_.lesson);
  }
  if (panels_.panels && session_.frame().scene) {
    area_.high.y -= timeline_.draw(session_, controls_, log_, area_);
  }
}

// The panel along the upper edge. Returns its height.
float Gui::top_panel() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float unit = ImGui::GetFontSize();
  const float top = std::round(ImGui::GetFrameHeight() + 0.9f * unit);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(ImGui::GetStyle().WindowPadding.x, 0.45f * unit));
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImVec2(whole.x, top));
  ImGui::Begin("top", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
  const BarButton pressed = top_bar(session_, controls_, panels_, host_.loudspeaker() != nullptr);
  ImGui::End();
  ImGui::PopStyleVar();
  if (pressed == BarButton::Sound) listen(!session_.listens());
  if (pressed == BarButton::Lecture) lecture_.toggle();
  return top;
}

void Gui::left_panel(float top, float width) {
  ImGui::SetNextWindowPos(ImVec2(0, top));
  ImGui::SetNextWindowSize(ImVec2(width, ImGui::GetIO().DisplaySize.y - top));
  ImGui::Begin("left", nullptr, kFixedPanel);
  controls_.group_row({"Gas", "Box and walls", "View", "Record"});
  ImGui::BeginChild("groups");
  all_controls();
  recorder_.draw(lecture_.theme());
  if (controls_.group("Window")) window_controls();
  ImGui::EndChild();
  ImGui::End();
}

// The groups of the gas.
void Gui::all_controls() {
  if (gas_panels(session_, controls_, mouse_tools_, plots_.titles())) lecture_.lift_pen();
}

// Where the top bar has no such button.
void Gui::sound_control() {
  if (host_.loudspeaker() && sound_button(session_, controls_, ImGui::GetContentRegionAvail().x)) {
    listen(!session_.listens());
  }
}

void Gui::window_controls() {
  text_scale_.draw(controls_);
  if (controls_.button("full_screen", "Full screen", "Enter or leave (F11)",
                       ImGui::GetContentRegionAvail().x)) {
    host_.toggle_full_screen();
  }
}

void Gui::plots_drawer(float top, float width) {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(whole.x - width, top));
  ImGui::SetNextWindowSize(ImVec2(width, whole.y - top));
  ImGui::Begin("plots", nullptr, kFixedPanel);
  plots_.draw(panel_theme(lecture_.shown_view()));
  ImGui::End();
}

void Gui::viewport() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const Frame& frame = session_.frame();
  if (std::exchange(told_gallery_, panels_.gallery) != panels_.gallery) {
    log_.event("gallery", {{"open", panels_.gallery}});
    if (!panels_.gallery) gallery_.forget();
  }
  if (panels_.gallery) {
    const EmbeddedFile* chosen = gallery_.draw(controls_, whole.x, whole.y, panels_.gallery);
    if (chosen) opener_.open(*chosen);
  }
  opener_.draw_question(lecture_.theme());
  recorder_.draw_dialog(lecture_.theme());
  if (panels_.help) help_window(session_.scene().dimension(), whole.x, whole.y);
  if (frame.opening || frame.bound_for) opening_note(session_, controls_, area_);
  if (!frame.scene) return;
  if (viewport_.drawn()) mouse_.use(area_.low, scale_);
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0.0f || ImGui::IsMouseDown(0) || panels_.gallery) panels_.hint = false;
  message_.draw(session_, area_);
  const bool quiet = message_.shown() || panels_.help || panels_.lecture || panels_.narrow ||
                     controls_.chooses() || !session_.view().captions.empty();
  const char* hint = mouse_tools_.hint();
  if (!quiet && hint) hint_line(hint, area_);
  log_.widget("viewport", area_.low.x, area_.low.y, area_.high.x - area_.low.x,
              area_.high.y - area_.low.y);
}

// Scale of the texts of the window. In lecture mode the window keeps room for the gas.
float Gui::letters() const {
  if (!panels_.lecture) return static_cast<float>(text_scale_.value());
  constexpr float kLetters = 1.6f;                  // least usual scale
  constexpr float kLegible = 0.025f;                // of the height of the window, 8 m away
  constexpr float kColumns = 39.0f, kRows = 20.0f;  // least size of the window, in text sizes
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float most =
      std::min(whole.x / kColumns, whole.y / kRows) / (kTextSize * host_.content_scale());
  const float usual = std::max(kLetters, kLegible * whole.y / (kTextSize * host_.content_scale()));
  return std::max(1.0f, std::min(usual * static_cast<float>(text_scale_.value()), most));
}

}  // namespace clatter
