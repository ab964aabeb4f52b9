#include "app/view/messages.h"

#include <algorithm>
#include <array>
#include <utility>

namespace clatter {

// A small window that ignores the mouse. `wrap` is its largest width; 0: unlimited.
static void begin_note(const char* name, ImVec2 place, ImVec2 pivot, float wrap = 0.0f) {
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(place, 0, pivot);
  if (wrap > 0.0f) ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(wrap, FLT_MAX));
  ImGui::SetNextWindowBgAlpha(0.96f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.4f * unit);
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
}

static void end_note() {
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

void hint_line(const Area& area) {
  const float unit = ImGui::GetFontSize();
  begin_note("hint", ImVec2(0.5f * (area.low.x + area.high.x), area.high.y - 3.6f * unit),
             ImVec2(0.5f, 1.0f));
  ImGui::TextDisabled("drag a slider  ·  scroll to zoom  ·  G for the gallery");
  end_note();
}

bool session_message(const Session& session, const Area& area) {
  constexpr double kShown = 10.0;  // duration of a message, seconds
  if (session.message().empty() || session.message_age() > kShown) return false;
  const float unit = ImGui::GetFontSize();
  const float wrap = 0.7f * (area.high.x - area.low.x);
  begin_note("told", ImVec2(0.5f * (area.low.x + area.high.x), area.high.y - 3.6f * unit),
             ImVec2(0.5f, 1.0f), wrap);
  ImGui::PushTextWrapPos(wrap - 2.0f * unit);
  ImGui::TextUnformatted(session.message().c_str());
  ImGui::PopTextWrapPos();
  end_note();
  return true;
}

static void show_collision(const char* which, const ParticleCollision& collision) {
  if (collision.partner) {
    ImGui::TextDisabled("%s t = %.4f, disk %u", which, collision.time, *collision.partner);
  } else {
    ImGui::TextDisabled("%s t = %.4f, %s wall", which, collision.time,
                        kSideNames[static_cast<std::size_t>(collision.side)]);
  }
}

void disk_label(const Frame& frame, std::size_t disk, bool follows, ImVec2 place,
                const Area& area) {
  const Snapshot& gas = frame.snapshot;
  if (disk >= gas.count()) return;
  const float unit = ImGui::GetFontSize();
  // The label is on the side of the disk that faces the middle of the area.
  const bool left = place.x > 0.5f * (area.low.x + area.high.x);
  const bool up = place.y > 0.5f * (area.low.y + area.high.y);
  begin_note("disk",
             ImVec2(std::clamp(place.x + (left ? -unit : unit), area.low.x, area.high.x),
                    std::clamp(place.y + (up ? -unit : unit), area.low.y, area.high.y)),
             ImVec2(left ? 1.0f : 0.0f, up ? 1.0f : 0.0f));
  ImGui::Text("Disk %zu", disk);
  const auto column = static_cast<Eigen::Index>(disk);
  const Vec2 r = gas.positions.col(column), v = gas.velocities.col(column);
  ImGui::TextDisabled("place %.2f, %.2f", r.x(), r.y());
  ImGui::TextDisabled("velocity %.3f, %.3f", v.x(), v.y());
  ImGui::TextDisabled("speed %.3f", v.norm());
  if (gas.spins.size() > 0) ImGui::TextDisabled("spin %.3f", gas.spins(0, column));
  if (frame.last_collision) show_collision("last hit", *frame.last_collision);
  if (frame.next_collision) show_collision("next hit", *frame.next_collision);
  ImGui::TextDisabled(follows ? "followed; Esc lets go" : "double-click to follow");
  end_note();
}

void help_window(float width, float height) {
  static constexpr std::array<std::pair<const char*, const char*>, 24> kKeys = {{
      {"Space", "play or pause"},
      {".", "next frame"},
      {"Shift + .", "next collision, with the pair marked"},
      {"R   Shift + R", "restart; with a new seed"},
      {"+  −", "faster, slower"},
      {"G", "gallery; / searches it"},
      {"[  ]", "previous scene, next scene"},
      {"Ctrl + Z   Ctrl + Y", "undo, redo"},
      {"Ctrl + Q", "quit"},
      {"Ctrl + S", "save the scene with its changes"},
      {"F2", "screenshot"},
      {"P", "plots"},
      {"T", "goal and suggestions of the scene"},
      {"M", "colour range of the disks: fixed or automatic"},
      {"Tab", "hide or show the panels"},
      {"L", "lecture: for a projector, large type, panels hidden"},
      {"F11", "full screen"},
      {"Esc", "close the open panel, or deselect the disk"},
      {"Scroll", "zoom about the cursor"},
      {"Right or middle drag", "move the view"},
      {"F", "fit the box into the view"},
      {"Click a disk", "its state; double-click follows it"},
      {"Drag a wall", "resize the box"},
      {"Drop a file", "open a scene, or the scene in a picture"},
  }};
  const float unit = ImGui::GetFontSize();
  begin_note("help", ImVec2(0.5f * width, 0.5f * height), ImVec2(0.5f, 0.5f));
  ImGui::TextUnformatted("Keys and mouse");
  ImGui::Spacing();
  for (const auto& [key, what] : kKeys) {
    ImGui::TextUnformatted(key);
    ImGui::SameLine(13.0f * unit);
    ImGui::TextDisabled("%s", what);
  }
  end_note();
}

}  // namespace clatter
