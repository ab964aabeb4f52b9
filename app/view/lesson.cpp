#include "app/view/lesson.h"

#include "app/view/style.h"

namespace clatter {

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
