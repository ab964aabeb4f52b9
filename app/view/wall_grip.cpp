#include "app/view/wall_grip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/style.h"
#include "render/layers/fonts.h"

namespace clatter {

static int axis_of(Side side) {
  return side / 2;
}

static bool is_low(Side side) {
  return side % 2 == 0;
}

Area WallGrip::handle(const Viewport& viewport, const Frame& frame, ImVec2 corner, float scale,
                      Side side) {
  const ImVec2 low = viewport.place(Vec2(0.0, 0.0), corner, scale);
  const ImVec2 high = viewport.place(frame.snapshot.box, corner, scale);
  const float depth = 1.2f * ImGui::GetFontSize();
  Area area{ImVec2(low.x, high.y), ImVec2(high.x, low.y)};
  switch (side) {
    case kLeft:
      area.high.x = std::exchange(area.low.x, low.x - depth);
      break;
    case kRight:
      area.low.x = std::exchange(area.high.x, high.x + depth);
      break;
    case kBottom:
      area.low.y = std::exchange(area.high.y, low.y + depth);
      break;
    case kTop:
      area.high.y = std::exchange(area.low.y, high.y - depth);
      break;
    case kBack:
    case kFront:
      break;  // not seen from the front
  }
  return area;
}

static std::optional<Side> wall_at(const Viewport& viewport, const Frame& frame, ImVec2 corner,
                                   float scale) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (const Side side : {kLeft, kRight, kBottom, kTop}) {
    if (!frame.snapshot.walls[side]) continue;
    const auto& [low, high] = WallGrip::handle(viewport, frame, corner, scale, side);
    if (mouse.x > low.x && mouse.x < high.x && mouse.y > low.y && mouse.y < high.y) return side;
  }
  return std::nullopt;
}

std::optional<WallGrip::Resized> WallGrip::use(const Viewport& viewport, const Frame& frame,
                                               ImVec2 corner, float scale, bool over) {
  constexpr double kShortest = 4.0;
  constexpr float kClick = 3.0f;  // a shorter motion of the mouse is a click, window units
  const Vec2 box = frame.snapshot.box;
  if (!held_) {
    side_ = over ? wall_at(viewport, frame, corner, scale) : std::nullopt;
    if (side_) length_ = box[axis_of(*side_)];
    held_ = side_ && ImGui::IsMouseClicked(0);
    moved_ = false;
    pressed_ = ImGui::GetIO().MousePos;
  }
  if (!side_) return std::nullopt;
  const int axis = axis_of(*side_);
  ImGui::SetMouseCursor(axis == 0 ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (!held_) return std::nullopt;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  moved_ |= std::hypot(mouse.x - pressed_.x, mouse.y - pressed_.y) >= kClick;
  if (moved_) {
    const double way =
        viewport.world(mouse, corner, scale)[axis] - viewport.world(pressed_, corner, scale)[axis];
    const double length = box[axis] + (is_low(*side_) ? -way : way);
    length_ = std::max(kShortest, 0.1 * std::round(10.0 * length));
  }
  if (!ImGui::IsMouseReleased(0)) return std::nullopt;
  held_ = false;
  if (box[axis] == length_) return std::nullopt;
  Resized resized{box, Vec2::Zero()};
  resized.box[axis] = length_;
  if (is_low(*side_)) resized.shift[axis] = length_ - box[axis];
  return resized;
}

void WallGrip::mark(ImDrawList& list, const Viewport& viewport, const Frame& frame, ImVec2 corner,
                    float scale) const {
  if (!side_) return;
  const int axis = axis_of(*side_);
  Vec2 from(0.0, 0.0), to = frame.snapshot.box;
  from[axis] = to[axis] = is_low(*side_) ? to[axis] - length_ : length_;
  const ImVec2 a = viewport.place(from, corner, scale), b = viewport.place(to, corner, scale);
  list.AddLine(a, b, packed(accent_colour()), 0.2f * ImGui::GetFontSize());
  if (!held_) return;
  const std::string text = fmt::format("{:.1f} a", length_);
  const float unit = ImGui::GetFontSize();
  list.AddText(ImVec2(b.x - (axis == 0 ? 4.0f * unit : 5.0f * unit), b.y - 1.5f * unit),
               ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace clatter
