#include "app/view/icons.h"

#include <imgui.h>

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

}  // namespace clatter
