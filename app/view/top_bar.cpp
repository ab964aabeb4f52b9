#include "app/view/top_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "app/view/style.h"
#include "render/theme.h"
#include "render/typeset_number.h"
#include "render/typography/fonts.h"

namespace clatter {

static void draw_icon(ImDrawList& list, Icon icon, ImVec2 centre, float r, ImU32 ink) {
  const auto at = [&](float x, float y) { return ImVec2(centre.x + x * r, centre.y + y * r); };
  switch (icon) {
    case Icon::Play:
      list.AddTriangleFilled(at(-0.6f, -0.9f), at(-0.6f, 0.9f), at(0.9f, 0.0f), ink);
      break;
    case Icon::Pause:
      list.AddRectFilled(at(-0.7f, -0.85f), at(-0.2f, 0.85f), ink);
      list.AddRectFilled(at(0.2f, -0.85f), at(0.7f, 0.85f), ink);
      break;
    case Icon::Frame:
      list.AddTriangleFilled(at(-0.8f, -0.8f), at(-0.8f, 0.8f), at(0.4f, 0.0f), ink);
      list.AddRectFilled(at(0.5f, -0.8f), at(0.85f, 0.8f), ink);
      break;
    case Icon::Collision:
      list.AddCircle(at(-0.5f, 0.0f), 0.5f * r, ink, 0, 0.2f * r);
      list.AddCircleFilled(at(0.5f, 0.0f), 0.5f * r, ink);
      break;
    case Icon::CollisionBack:
      list.AddCircleFilled(at(-0.5f, 0.0f), 0.5f * r, ink);
      list.AddCircle(at(0.5f, 0.0f), 0.5f * r, ink, 0, 0.2f * r);
      break;
    case Icon::Back:
      list.AddTriangleFilled(at(0.6f, -0.9f), at(0.6f, 0.9f), at(-0.9f, 0.0f), ink);
      break;
    case Icon::Head:
      list.AddTriangleFilled(at(-0.8f, -0.8f), at(-0.8f, 0.8f), at(0.0f, 0.0f), ink);
      list.AddTriangleFilled(at(-0.1f, -0.8f), at(-0.1f, 0.8f), at(0.7f, 0.0f), ink);
      list.AddRectFilled(at(0.7f, -0.8f), at(0.95f, 0.8f), ink);
      break;
    case Icon::Reset:
      list.PathArcTo(centre, 0.75f * r, -0.7f, 4.2f, 24);
      list.PathStroke(ink, 0, 0.25f * r);
      list.AddTriangleFilled(at(0.15f, -0.45f), at(0.95f, -0.45f), at(0.75f, -1.15f), ink);
      break;
  }
}

bool icon_button(Controls& controls, const char* key, Icon icon, const char* help) {
  if (!controls.shows(key)) return false;
  const float height = ImGui::GetFrameHeight();
  ImGui::PushID(key);
  const bool clicked = controls.button(key, "##icon", help, 1.35f * height);
  ImGui::PopID();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  draw_icon(*ImGui::GetWindowDrawList(), icon,
            ImVec2(0.5f * (low.x + high.x), 0.5f * (low.y + high.y)), 0.28f * height,
            ImGui::GetColorU32(ImGuiCol_Text));
  ImGui::SameLine();
  return clicked;
}

namespace {

// A button for one sign.
bool sign_button(Controls& controls, const char* key, const char* sign, const char* help) {
  if (!controls.shows(key)) return false;
  const bool clicked = controls.button(key, sign, help, 1.1f * ImGui::GetFrameHeight());
  ImGui::SameLine();
  return clicked;
}

void speed_field(Session& session, Controls& controls) {
  constexpr float kWide = 75.0f;  // width of a window with room for the whole unit, text sizes
  const float unit = ImGui::GetFontSize();
  const bool wide = right_edge() > kWide * unit;
  if (sign_button(controls, "slower", "−", "Slower ( - )")) session.change_speed(false);
  if (controls.shows("speed")) {
    const std::string text =
        fmt::format("{:.3g} {}/s", session.frame().speed, wide ? "time units" : "");
    ImGui::AlignTextToFramePadding();
    const float left = ImGui::GetCursorPosX();
    ImGui::TextUnformatted(text.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Simulation time per second");
    ImGui::SameLine(left + (wide ? 8.8f : 4.2f) * unit);
  }
  if (sign_button(controls, "faster", "+", "Faster ( + )")) session.change_speed(true);
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

// A rate with three digits, and a thin space between groups of them.
std::string rate_text(double rate) {
  if (rate < 100.0) return fmt::format("{:.3g}", rate);
  const double unit = std::pow(10.0, std::floor(std::log10(rate)) - 2.0);
  return grouped_digits(static_cast<std::uint64_t>(unit * std::round(rate / unit)));
}

// Speed, collision rate, time and health at the right end of the bar, and a hint before them, as
// far as there is room.
void figures(const Frame& frame, Controls& controls, const std::string& hint) {
  const float unit = ImGui::GetFontSize();
  const float right = right_edge() - 1.4f * unit;
  const float room = right - ImGui::GetCursorPosX();
  const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  std::string text;
  const auto put_before = [&](const std::string& figure) {
    if (width(figure + text) < room) text = figure + text;
  };
  put_before(fmt::format("t = {:.2f}", frame.snapshot.time));
  if (frame.plays) put_before(rate_text(frame.events_per_second) + " collisions/s   ");
  if (frame.plays && frame.held < 0.95) put_before(fmt::format("{:.2g}x   ", frame.held));
  const float free = room - width(text) - width(hint);
  if (!hint.empty() && free > 4.0f * unit) {
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.5f * free);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", hint.c_str());
    ImGui::SameLine();
  }
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

bool sound_button(const Session& session, Controls& controls, float width) {
  return controls.button("sound", "Sound", "A click for each collision (S)", width,
                         session.listens());
}

BarButton top_bar(Session& session, Controls& controls, PanelVisibility& shown, bool has_sound) {
  if (shown.narrow) {
    const float icon = 1.35f * ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x;
    gallery_button(session, controls, shown, right_edge() - 3.0f * icon);
    play_button(session, controls);
    reset_button(session, controls);
    figures(session.frame(), controls, "");
    return BarButton::None;
  }
  BarButton pressed = BarButton::None;
  constexpr float kOthers = 40.0f;  // width of the other widgets and the light, text sizes
  gallery_button(session, controls, shown, right_edge() - kOthers * ImGui::GetFontSize());
  play_button(session, controls);
  step_buttons(session, controls);
  reset_button(session, controls);
  speed_field(session, controls);
  if (has_sound) {
    if (sound_button(session, controls, 0.0f)) pressed = BarButton::Sound;
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
  const bool disks = session.frame().snapshot.box.size() == 2;
  const std::string hint = std::string(disks ? "drag a slider" : "drag to turn") +
                           "  ·  scroll to zoom  ·  G for the gallery";
  figures(session.frame(), controls, shown.hint ? hint : "");
  return pressed;
}

}  // namespace clatter
