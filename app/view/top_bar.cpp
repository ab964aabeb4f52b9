#include "app/view/top_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/view/icons.h"
#include "app/view/style.h"
#include "render/layers/fonts.h"
#include "render/theme.h"

namespace clatter {

namespace {

// A button for one sign.
bool sign_button(Controls& controls, const char* key, const char* sign, const char* help) {
  if (!controls.shows(key)) return false;
  const bool clicked = controls.button(key, sign, help, 1.1f * ImGui::GetFrameHeight());
  ImGui::SameLine();
  return clicked;
}

void speed_field(Session& session, Controls& controls) {
  const double speed = session.frame().speed;
  if (sign_button(controls, "slower", "−", "Slower ( - )")) {
    session.set_speed(speed / std::sqrt(2.0));
  }
  if (controls.shows("speed")) {
    const std::string text = fmt::format("{:.3g} /s", speed);
    ImGui::AlignTextToFramePadding();
    const float left = ImGui::GetCursorPosX();
    ImGui::TextUnformatted(text.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Simulation time per second");
    ImGui::SameLine(left + 4.2f * ImGui::GetFontSize());
  }
  if (sign_button(controls, "faster", "+", "Faster ( + )")) {
    session.set_speed(speed * std::sqrt(2.0));
  }
}

struct Health {
  Colour colour;
  std::string reasons;
};

Health health_of(const Frame& frame) {
  const Colour good = {0x6c, 0xc0, 0x7a}, warns = {0xf2, 0xc1, 0x4e}, bad = {0xe0, 0x6c, 0x5a};
  constexpr double kDeepest = 1e-9, kResidual = 1e-9, kHeld = 0.95;
  Health health{good,
                fmt::format("Deepest overlap {:.1e} diameters\nEnergy against its ledger {:.1e}\n"
                            "Engine holds {:.0f} % of the speed",
                            frame.deepest_overlap, frame.ledger_residual, 100.0 * frame.held)};
  if (frame.held < kHeld) health.colour = warns;
  if (frame.deepest_overlap > kDeepest || std::fabs(frame.ledger_residual) > kResidual) {
    health.colour = bad;
  }
  if (!frame.stop.empty()) {
    health.colour = bad;
    health.reasons = frame.stop + "\n\n" + health.reasons;
  }
  return health;
}

// Speed, collision rate, time and health at the right end of the bar, as far as there is room.
void figures(const Frame& frame, Controls& controls) {
  const float unit = ImGui::GetFontSize();
  const float right = ImGui::GetContentRegionMax().x - 1.4f * unit;
  const float room = right - ImGui::GetCursorPosX();
  const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  std::string text;
  const auto put_before = [&](const std::string& figure) {
    if (width(figure + text) < room) text = figure + text;
  };
  put_before(fmt::format("t = {:.2f}", frame.snapshot.time));
  if (frame.plays) put_before(fmt::format("{:.3g} collisions/s   ", frame.events_per_second));
  if (frame.plays && frame.held < 0.95) put_before(fmt::format("{:.2g}x   ", frame.held));
  ImGui::SetCursorPosX(right - width(text));
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text.c_str());
  ImGui::SameLine();
  const Health health = health_of(frame);
  controls.area("health", unit, ImGui::GetFrameHeight(), health.reasons);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImGui::GetWindowDrawList()->AddCircleFilled(
      ImVec2(0.5f * (low.x + high.x), 0.5f * (low.y + high.y)), 0.3f * unit, packed(health.colour));
}

// Opens and closes the gallery. The title of the scene is cut at `widest` pixels.
void gallery_button(const Session& session, Controls& controls, PanelVisibility& shown,
                    float widest) {
  const std::string& title = session.scene().title;
  const std::string label = "≡  " + (title.empty() ? "Untitled" : title);
  const float width =
      ImGui::CalcTextSize(label.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
  if (controls.button("gallery", (label + "###gallery").c_str(), "The gallery (G)",
                      std::min(width, widest))) {
    shown.toggle_gallery();
  }
  ImGui::SameLine();
}

void play_button(Session& session, Controls& controls) {
  const bool plays = session.frame().plays;
  if (icon_button(controls, "play", plays ? Icon::Pause : Icon::Play,
                  plays ? "Pause (Space)" : "Play (Space)")) {
    session.play(!plays);
  }
}

void reset_button(Session& session, Controls& controls) {
  if (icon_button(controls, "reset", Icon::Reset, "Restart (R; Shift+R with a new seed)")) {
    session.restart();
  }
}

void step_buttons(Session& session, Controls& controls) {
  if (icon_button(controls, "frame", Icon::Frame, "Next frame ( . )")) session.step_frame();
  if (icon_button(controls, "collision", Icon::Collision, "Next collision (Shift + . )")) {
    session.step_collision();
  }
}

}  // namespace

void step_row(Session& session, Controls& controls) {
  step_buttons(session, controls);
  speed_field(session, controls);
  const bool drawn = ImGui::GetCursorPosX() > ImGui::GetCursorStartPos().x;
  if (drawn) ImGui::NewLine();
}

void play_row(Session& session, Controls& controls) {
  play_button(session, controls);
  reset_button(session, controls);
  step_row(session, controls);
}

BarButton top_bar(Session& session, Controls& controls, PanelVisibility& shown, bool has_sound) {
  if (shown.narrow) {
    const float icon = 1.35f * ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x;
    gallery_button(session, controls, shown, ImGui::GetContentRegionMax().x - 3.0f * icon);
    play_button(session, controls);
    reset_button(session, controls);
    figures(session.frame(), controls);
    return BarButton::None;
  }
  BarButton pressed = BarButton::None;
  gallery_button(session, controls, shown, FLT_MAX);
  play_button(session, controls);
  step_buttons(session, controls);
  reset_button(session, controls);
  speed_field(session, controls);
  if (has_sound) {
    if (controls.button("sound", "Sound", "A click for each collision (S)", 0.0f,
                        session.listens())) {
      pressed = BarButton::Sound;
    }
    ImGui::SameLine();
  }
  if (controls.button("plots", "Plots", "Curves of the run (P)")) shown.toggle(Sheet::Plots);
  ImGui::SameLine();
  if (controls.button("lesson", "Try this", "Goal and suggestions (T)")) {
    shown.toggle(Sheet::Lesson);
  }
  ImGui::SameLine();
  if (controls.button("lecture", "Lecture", "Large type, for a projector (L)")) {
    pressed = BarButton::Lecture;
  }
  ImGui::SameLine();
  if (controls.button("help", "?", "Keys and mouse (F1)")) shown.toggle_help();
  ImGui::SameLine();
  figures(session.frame(), controls);
  return pressed;
}

}  // namespace clatter
