#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/view/gui.h"
#include "app/view/panels.h"
#include "app/view/style.h"
#include "app/view/top_bar.h"

// The panels of narrow windows, one sheet at a time, and of an embedded gas.

namespace clatter {

static constexpr struct {
  Sheet sheet;
  const char* key;
  const char* title;
} kSheets[] = {{Sheet::Run, "sheet.run", "Run"},       {Sheet::Gas, "sheet.gas", "Gas"},
               {Sheet::View, "sheet.view", "View"},    {Sheet::Record, "sheet.record", "Record"},
               {Sheet::Plots, "sheet.plots", "Plots"}, {Sheet::Lesson, "sheet.lesson", "Goal"}};

// Bars at the upper and lower edge, and the open sheet below or beside the gas.
void Gui::sheets() {
  if (!panels_.panels) return;
  area_.low.y = top_panel();
  area_.high.y -= sheet_bar();
  if (panels_.sheet != Sheet::None && session_.frame().scene) sheet();
}

// The bar with a button for each sheet. Returns its height.
float Gui::sheet_bar() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float edge = 0.45f * ImGui::GetFontSize();
  const float height = std::round(ImGui::GetFrameHeight() + 2.0f * edge);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(edge, edge));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(edge, edge));
  ImGui::SetNextWindowPos(ImVec2(0, whole.y - height));
  ImGui::SetNextWindowSize(ImVec2(whole.x, height));
  ImGui::Begin("sheets", nullptr, kFixedPanel | ImGuiWindowFlags_NoScrollbar);
  float text = 0.0f;
  for (const auto& [sheet, key, title] : kSheets) text += ImGui::CalcTextSize(title).x;
  constexpr auto kCount = static_cast<float>(std::size(kSheets));
  const float around = (ImGui::GetContentRegionAvail().x - text - (kCount - 1.0f) * edge) / kCount;
  for (const auto& [sheet, key, title] : kSheets) {
    const bool open = panels_.sheet == sheet;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, ImGui::GetStyle().FramePadding.y));
    if (controls_.button(key, title, "", ImGui::CalcTextSize(title).x + around, open)) {
      panels_.toggle(sheet);
    }
    ImGui::PopStyleVar();
    ImGui::SameLine();
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  return height;
}

// The open sheet: the lower half of a tall window, or the right part of a wide one. Its heading
// closes it by a click, or by a motion of the wheel or a finger towards the lower edge.
void Gui::sheet() {
  constexpr float kHalf = 0.5f, kWidth = 20.0f;
  Area place = area_;
  if (place.high.y > place.high.x) {
    area_.high.y = place.low.y = std::round(std::lerp(area_.low.y, area_.high.y, kHalf));
  } else {
    const float width = std::min(kWidth * ImGui::GetFontSize(), kHalf * place.high.x);
    area_.high.x = place.low.x = std::round(place.high.x - width);
  }
  ImGui::SetNextWindowPos(place.low);
  ImGui::SetNextWindowSize(ImVec2(place.high.x - place.low.x, place.high.y - place.low.y));
  ImGui::Begin("sheet", nullptr,
               kFixedPanel | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  const bool closes = controls_.button("sheet.close", "×", "", ImGui::GetContentRegionAvail().x);
  if (closes || (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel > 0.0f)) {
    panels_.toggle(panels_.sheet);
  }
  ImGui::BeginChild(static_cast<ImGuiID>(panels_.sheet) + 1);
  switch (panels_.sheet) {
    case Sheet::None:
      break;
    case Sheet::Run:
      step_row(session_, controls_);
      sound_control();
      accuracy_panel(session_, controls_);
      break;
    case Sheet::Gas:
      gas_panel(session_, controls_);
      compare_panel(session_, controls_, plots_.titles());
      mouse_tools_.panel(session_.scene(), controls_);
      box_panel(session_, controls_);
      break;
    case Sheet::View:
      view_panel(session_, controls_);
      window_controls();
      break;
    case Sheet::Record:
      recorder_.draw(lecture_.theme());
      break;
    case Sheet::Plots:
      plots_.draw(panel_theme(lecture_.shown_view()));
      break;
    case Sheet::Lesson:
      for (const std::string* text : {&session_.scene().goal, &session_.scene().try_this}) {
        ImGui::TextWrapped("%s", text->c_str());
        ImGui::Spacing();
      }
      break;
  }
  ImGui::EndChild();
  ImGui::End();
}

// A strip below the gas with the controls that were chosen.
void Gui::chosen_controls() {
  if (!session_.frame().scene) return;
  constexpr float kHighest = 0.5f;  // share of the window
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float height = std::min(strip_, kHighest * whole.y);
  area_.high.y -= height;
  ImGui::SetNextWindowPos(ImVec2(0, area_.high.y));
  ImGui::SetNextWindowSize(ImVec2(whole.x, std::max(height, 1.0f)));
  ImGui::Begin("chosen", nullptr, kFixedPanel);
  const float start = ImGui::GetCursorPosY();
  play_row(session_, controls_);
  sound_control();
  all_controls();
  recorder_.draw(lecture_.theme());
  window_controls();
  const float end = ImGui::GetCursorPosY();
  const bool empty = end == start;
  strip_ = empty ? 0.0f : end - ImGui::GetStyle().ItemSpacing.y + ImGui::GetStyle().WindowPadding.y;
  ImGui::End();
  controls_.report_missing(checked_run_);
  checked_run_ = session_.frame().run;
}

bool Gui::shows_gas(float x, float y) const {
  return !panels_.gallery && !panels_.help && x >= area_.low.x && x < area_.high.x &&
         y >= area_.low.y && y < area_.high.y;
}

}  // namespace clatter
