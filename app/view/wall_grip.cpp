#include "app/view/wall_grip.h"

#include <algorithm>
#include <cmath>

#include "app/view/style.h"
#include "render/layers/fonts.h"

namespace clatter {

// Where a wall can be taken: it has a side opposite, and the mouse is near it, in units of text.
static std::optional<int> wall_at(const Stage& stage, const Frame& frame, ImVec2 corner,
                                  float scale) {
  const Vec2& box = frame.snapshot.box;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 low = stage.place(Vec2(0.0, 0.0), corner, scale);
  const ImVec2 high = stage.place(box, corner, scale);
  const float reach = 0.6f * ImGui::GetFontSize();
  const bool beside = mouse.y > high.y - reach && mouse.y < low.y + reach;
  const bool above = mouse.x > low.x - reach && mouse.x < high.x + reach;
  const auto& walls = frame.snapshot.walls;
  // Just outside it, where there are no disks to be picked.
  if (walls[kRight] && beside && mouse.x > high.x && mouse.x < high.x + 2.0f * reach) return 0;
  if (walls[kTop] && above && mouse.y < high.y && mouse.y > high.y - 2.0f * reach) return 1;
  return std::nullopt;
}

std::optional<Vec2> WallGrip::use(const Stage& stage, const Frame& frame, ImVec2 corner,
                                  float scale, bool over) {
  constexpr double kShortest = 4.0;
  if (!held_) {
    axis_ = over ? wall_at(stage, frame, corner, scale) : std::nullopt;
    if (axis_) length_ = frame.snapshot.box[*axis_];
    held_ = axis_ && ImGui::IsMouseClicked(0);
  }
  if (!axis_) return std::nullopt;
  ImGui::SetMouseCursor(*axis_ == 0 ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (!held_) return std::nullopt;
  const Vec2 mouse = stage.world(ImGui::GetIO().MousePos, corner, scale);
  length_ = std::max(kShortest, 0.1 * std::round(10.0 * mouse[*axis_]));
  if (!ImGui::IsMouseReleased(0)) return std::nullopt;
  held_ = false;
  Vec2 box = frame.snapshot.box;
  if (box[*axis_] == length_) return std::nullopt;
  box[*axis_] = length_;
  return box;
}

void WallGrip::mark(ImDrawList& list, const Stage& stage, const Frame& frame, ImVec2 corner,
                    float scale) const {
  if (!axis_) return;
  Vec2 from(0.0, 0.0), to = frame.snapshot.box;
  from[*axis_] = to[*axis_] = length_;
  const ImVec2 a = stage.place(from, corner, scale), b = stage.place(to, corner, scale);
  list.AddLine(a, b, packed(accent_colour()), 0.2f * ImGui::GetFontSize());
  if (!held_) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.1f a", length_);
  const float unit = ImGui::GetFontSize();
  list.AddText(ImVec2(b.x - (*axis_ == 0 ? 4.0f * unit : 5.0f * unit), b.y - 1.5f * unit),
               ImGui::GetColorU32(ImGuiCol_Text), text);
}

}  // namespace clatter
