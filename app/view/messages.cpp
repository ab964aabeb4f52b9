#include "app/view/messages.h"

#include <fmt/printf.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/view/style.h"
#include "engine/text.h"

namespace clatter {

// A small window that ignores the mouse.
static void begin_note(const char* name, ImVec2 place, ImVec2 pivot) {
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(place, 0, pivot);
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

void hint_line(const std::string& text, const Area& area) {
  const float unit = ImGui::GetFontSize();
  begin_note("hint", ImVec2(0.5f * (area.low.x + area.high.x), area.high.y - 3.6f * unit),
             ImVec2(0.5f, 1.0f));
  ImGui::TextDisabled("%s", text.c_str());
  end_note();
}

void opening_note(Session& session, Controls& controls, const Area& area) {
  constexpr float kWidth = 18.0f;  // text sizes
  const float unit = ImGui::GetFontSize();
  const float width = std::min(kWidth * unit, area.high.x - area.low.x);
  ImGui::SetNextWindowPos(
      ImVec2(0.5f * (area.low.x + area.high.x), 0.5f * (area.low.y + area.high.y)), 0,
      ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(width, 0.0f));
  ImGui::Begin("opening", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
  const Scene& scene = session.scene();
  const Frame& frame = session.frame();
  std::string text = "Placing " + counted(static_cast<std::size_t>(scene.particles.count),
                                          scene.dimension() == 2 ? "disk" : "sphere");
  double done = frame.opening.value_or(0.0);
  const char* help = "Keeps the former gas (Esc)";
  if (frame.bound_for) {
    text = "Running to t = " + number_text(*frame.bound_for);
    done = frame.snapshot.time / *frame.bound_for;
    help = "Stays at the time reached (Esc)";
  }
  ImGui::TextUnformatted(text.c_str());
  ImGui::ProgressBar(static_cast<float>(done));
  if (frame.run > 0 &&
      controls.button("opening.cancel", "Cancel", help, ImGui::GetContentRegionAvail().x)) {
    session.cancel_open();
  }
  ImGui::End();
}

void MessageNote::draw(const Session& session, const Area& area) {
  constexpr float kShortest = 4.0f, kLongest = 8.0f, kPerLetter = 0.06f;  // seconds
  constexpr float kFade = 0.5f;
  const std::string& text = session.message();
  const float whole = std::clamp(kPerLetter * static_cast<float>(text.size()), kShortest, kLongest);
  if (number_ != session.messages()) {
    number_ = session.messages();
    left_ = whole;
  } else {
    left_ -= ImGui::GetIO().DeltaTime;
  }
  if (!shown()) return;
  const float unit = ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::min(1.0f, left_ / kFade));
  begin_note("told", ImVec2(0.5f * (area.low.x + area.high.x), area.high.y - 3.6f * unit),
             ImVec2(0.5f, 1.0f));
  ImGui::PushTextWrapPos(0.7f * (area.high.x - area.low.x) - 2.0f * unit);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  if (ImGui::IsMouseHoveringRect(low, ImVec2(low.x + size.x, low.y + size.y), false)) left_ = whole;
  end_note();
  ImGui::PopStyleVar();
}

static void show_collision(const char* which, const ParticleCollision& collision, bool disks) {
  if (collision.partner) {
    ImGui::TextDisabled("%s t = %.4f, %s %u", which, collision.time, disks ? "disk" : "sphere",
                        *collision.partner);
  } else if (!collision.fixture.empty()) {
    ImGui::TextDisabled("%s t = %.4f, %s", which, collision.time, collision.fixture.c_str());
  } else {
    ImGui::TextDisabled("%s t = %.4f, %s wall", which, collision.time,
                        kSideNames[static_cast<std::size_t>(collision.side)]);
  }
}

static void show_vector(const char* name, const VecX& vector, const char* format) {
  std::string text;
  for (const double component : vector) {
    text += (text.empty() ? "" : ", ") + fmt::sprintf(format, component);
  }
  ImGui::TextDisabled("%s %s", name, text.c_str());
}

void particle_label(const Frame& frame, std::size_t particle, bool follows, ImVec2 place,
                    const Area& area) {
  const Snapshot& gas = frame.snapshot;
  if (particle >= gas.count()) return;
  const float unit = ImGui::GetFontSize();
  // The label is on the side of the particle that faces the middle of the area.
  const bool left = place.x > 0.5f * (area.low.x + area.high.x);
  const bool up = place.y > 0.5f * (area.low.y + area.high.y);
  begin_note("particle",
             ImVec2(std::clamp(place.x + (left ? -unit : unit), area.low.x, area.high.x),
                    std::clamp(place.y + (up ? -unit : unit), area.low.y, area.high.y)),
             ImVec2(left ? 1.0f : 0.0f, up ? 1.0f : 0.0f));
  const bool disks = gas.positions.rows() == 2;
  ImGui::Text("%s %zu", disks ? "Disk" : "Sphere", particle);
  const auto column = static_cast<Eigen::Index>(particle);
  show_vector("position", gas.positions.col(column), "%.2f");
  show_vector("velocity", gas.velocities.col(column), "%.3f");
  ImGui::TextDisabled("speed %.3f", gas.velocities.col(column).norm());
  if (gas.spins.size() > 0) show_vector("spin", gas.spins.col(column), "%.3f");
  if (frame.last_collision) show_collision("last collision", *frame.last_collision, disks);
  if (frame.next_collision) show_collision("next collision", *frame.next_collision, disks);
  ImGui::TextDisabled(follows ? "followed; Esc stops following" : "double-click to follow");
  ImGui::TextDisabled("V shows or hides its path");
  end_note();
}

namespace {

// Keys or mouse actions and their effect.
struct KeyLine {
  const char* key;
  const char* effect;
  bool spheres_only = false;
};

constexpr std::array<KeyLine, 34> kKeyLines = {{
    {"Space", "play or pause"},
    {"B", "play backwards, or forwards again"},
    {".  ,", "next frame, previous frame"},
    {"Shift + .   Shift + ,", "next, previous collision, with the pair marked"},
    {"←  →   Home   End", "back, forth by a second of playing; start, latest time"},
    {"Shift + drag", "on the timeline: repeat this stretch; a click ends that"},
    {"Drag a mark", "on the timeline: move a change to another time"},
    {"R   Shift + R", "restart; with a new seed"},
    {"+  −", "faster, slower"},
    {"S", "sound of the collisions"},
    {"G", "gallery; letters search it"},
    {"[  ]", "previous scene, next scene"},
    {"Ctrl + Z   Ctrl + Y", "undo, redo"},
    {"Ctrl + Q", "quit"},
    {"Ctrl + S   F2", "save the scene with its changes; screenshot"},
    {"P", "plots"},
    {"C   N", "compare: a copy of the gas beside it; the next gas"},
    {"T", "goal and suggestions of the scene"},
    {"M", "colour range of the particles: fixed or automatic"},
    {"V", "path of the picked particle"},
    {"Tab", "hide or show the panels"},
    {"L", "lecture: large type, three sliders and a plot"},
    {"D  E  K  W", "lecture: pen, wipe, pointer with a trail, stopwatch"},
    {"F11", "full screen"},
    {"1 to 8", "heat, cool, kick, throw, add particles; draw balls, walls, erase"},
    {"Esc", "close the open panel, end a tool, or deselect the particle"},
    {"Drag", "turn the view", true},
    {"X  Y  Z  I", "view along an axis, isometric view", true},
    {"Right or Shift + drag", "move the view"},
    {"Scroll   F", "zoom about the cursor; fit the box"},
    {"Click a particle", "its state; double-click follows it"},
    {"Drag a wall", "resize the box; press just outside of it"},
    {"Drag the right wall", "a piston, while the gas plays; with Shift: resize"},
    {"Drop a file", "open a scene, or the scene in a picture"},
}};

}  // namespace

void help_window(int dimension, float width, float height) {
  begin_note("help", ImVec2(0.5f * width, 0.5f * height), ImVec2(0.5f, 0.5f));
  // The large letters of lecture mode shrink where the list would be higher than the window.
  ImGui::SetWindowFontScale(1.0f);
  const float lines = static_cast<float>(kKeyLines.size()) + 3.0f;
  const float needed = lines * ImGui::GetTextLineHeightWithSpacing();
  const float scale = std::min(1.0f, height / needed);
  const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
  ImGui::SetWindowFontScale(scale);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(scale * spacing.x, scale * spacing.y));
  const float unit = ImGui::GetFontSize();
  ImGui::TextUnformatted("Keys and mouse");
  ImGui::Spacing();
  for (const auto& [key, effect, spheres_only] : kKeyLines) {
    if (spheres_only && dimension == 2) continue;
    ImGui::TextUnformatted(key);
    ImGui::SameLine(13.0f * unit);
    ImGui::TextDisabled("%s", effect);
  }
  ImGui::PopStyleVar();
  end_note();
}

static void line(const char* heading, const std::string& text, float left) {
  if (text.empty()) return;
  ImGui::TextDisabled("%s", heading);
  ImGui::SameLine(left);
  ImGui::TextUnformatted(text.c_str());
}

float lesson_strip(const Scene& scene, const Area& area, Controls& controls, bool& open) {
  if (scene.goal.empty() && scene.try_this.empty()) return 0.0f;
  const float unit = ImGui::GetFontSize(), width = area.high.x - area.low.x;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float left = style.WindowPadding.x + 5.0f * unit;
  const float right = width - style.WindowPadding.x - 2.0f * unit;
  float height = 2.0f * style.WindowPadding.y - style.ItemSpacing.y;
  for (const std::string* text : {&scene.goal, &scene.try_this}) {
    if (text->empty()) continue;
    height += ImGui::CalcTextSize(text->c_str(), nullptr, false, right - left).y;
    height += style.ItemSpacing.y;
  }
  ImGui::SetNextWindowPos(ImVec2(area.low.x, area.high.y - height));
  ImGui::SetNextWindowSize(ImVec2(width, height));
  ImGui::Begin("lesson", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
  ImGui::PushTextWrapPos(right);
  line("Goal", scene.goal, left);
  line("Try this", scene.try_this, left);
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPos(ImVec2(right + 0.6f * unit, 0.6f * style.WindowPadding.y));
  if (controls.button("close_lesson", "×", "Close (T)")) open = false;
  ImGui::End();
  return height;
}

}  // namespace clatter
