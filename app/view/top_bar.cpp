#include "app/view/top_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "app/view/icons.h"
#include "app/view/style.h"
#include "render/layers/fonts.h"
#include "render/theme.h"

namespace clatter {

namespace {

void speed_field(Session& session, Controls& controls) {
  const double speed = session.frame().speed;
  if (controls.button("slower", "−", "Slower ( - )")) session.set_speed(speed / std::sqrt(2.0));
  ImGui::SameLine();
  const std::string text = fmt::format("{:.3g} /s", speed);
  ImGui::AlignTextToFramePadding();
  const float left = ImGui::GetCursorPosX();
  ImGui::TextUnformatted(text.c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Simulation time per second");
  ImGui::SameLine(left + 4.2f * ImGui::GetFontSize());
  if (controls.button("faster", "+", "Faster ( + )")) session.set_speed(speed * std::sqrt(2.0));
  ImGui::SameLine();
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

// Speed, collision rate, time and health at the right end of the bar.
void figures(const Frame& frame, Controls& controls) {
  std::string text;
  if (frame.plays && frame.held < 0.95) text += fmt::format("{:.2g}x   ", frame.held);
  if (frame.plays) text += fmt::format("{:.3g} collisions/s   ", frame.events_per_second);
  text += fmt::format("t = {:.2f}", frame.snapshot.time);
  const float unit = ImGui::GetFontSize();
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SameLine(ImGui::GetContentRegionMax().x - width - 1.4f * unit);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", text.c_str());
  ImGui::SameLine();
  const Health health = health_of(frame);
  controls.area("health", unit, ImGui::GetFrameHeight(), health.reasons);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImGui::GetWindowDrawList()->AddCircleFilled(
      ImVec2(0.5f * (low.x + high.x), 0.5f * (low.y + high.y)), 0.3f * unit, packed(health.colour));
}

}  // namespace

void top_bar(Session& session, Controls& controls, PanelVisibility& shown) {
  const Frame& frame = session.frame();
  const std::string title = session.scene().title.empty() ? "Untitled" : session.scene().title;
  if (controls.button("gallery", ("≡  " + title + "##gallery").c_str(), "The gallery (G)")) {
    shown.toggle_gallery();
  }
  ImGui::SameLine();
  const bool plays = frame.plays;
  if (icon_button(controls, "play", plays ? Icon::Pause : Icon::Play,
                  plays ? "Pause (Space)" : "Play (Space)")) {
    session.play(!plays);
  }
  if (icon_button(controls, "frame", Icon::Frame, "Next frame ( . )")) session.step_frame();
  if (icon_button(controls, "collision", Icon::Collision, "Next collision (Shift + . )")) {
    session.step_collision();
  }
  if (icon_button(controls, "reset", Icon::Reset, "Restart (R; Shift+R with a new seed)")) {
    session.restart();
  }
  speed_field(session, controls);
  if (controls.button("plots", "Plots", "Curves of the run (P)")) shown.plots = !shown.plots;
  ImGui::SameLine();
  if (controls.button("lesson", "Try this", "Goal and suggestions (T)")) {
    shown.lesson = !shown.lesson;
  }
  ImGui::SameLine();
  if (controls.button("help", "?", "Keys and mouse (F1)")) shown.toggle_help();
  figures(frame, controls);
}

}  // namespace clatter
