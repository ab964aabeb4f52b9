#include "app/view/wall_grip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/style.h"
#include "render/picking.h"
#include "render/typography/fonts.h"

namespace clatter {

namespace {

int axis_of(Side side) {
  return side / 2;
}

bool is_low(Side side) {
  return side % 2 == 0;
}

ImVec2 operator+(ImVec2 a, ImVec2 b) {
  return {a.x + b.x, a.y + b.y};
}

ImVec2 operator-(ImVec2 a, ImVec2 b) {
  return {a.x - b.x, a.y - b.y};
}

ImVec2 operator*(float factor, ImVec2 a) {
  return {factor * a.x, factor * a.y};
}

float dot(ImVec2 a, ImVec2 b) {
  return a.x * b.x + a.y * b.y;
}

// The extents of the box, along x up to the piston.
VecX room_of(const Snapshot& gas) {
  VecX room = gas.box;
  room[0] -= gas.piston_travel;
  return room;
}

// An edge of a face: its ends in the world, and the sides that meet there; one of a box of disks.
struct Edge {
  std::array<VecX, 2> ends;
  std::vector<Side> sides;
};

std::vector<Edge> edges_of(const VecX& box) {
  std::vector<Edge> edges;
  const auto dimension = static_cast<int>(box.size());
  for (int along = 0; along < dimension; ++along) {
    for (int corner = 0; corner < 1 << dimension; ++corner) {
      const auto high = [&](int axis) { return (corner >> axis) & 1; };
      if (high(along)) continue;  // the other end of the edge
      Edge edge{{VecX::Zero(dimension), {}}, {}};
      for (int axis = 0; axis < dimension; ++axis) {
        if (axis == along) continue;
        if (high(axis)) edge.ends[0][axis] = box[axis];
        edge.sides.push_back(static_cast<Side>(2 * axis + high(axis)));
      }
      edge.ends[1] = edge.ends[0];
      edge.ends[1][along] = box[along];
      edges.push_back(edge);
    }
  }
  return edges;
}

// Whether the outer face of a side is turned to the viewer.
bool faces_viewer(const Eye& eye, const VecX& box, Side side) {
  const int axis = axis_of(side);
  Vec3 place = in_space(box);
  if (is_low(side)) place[axis] = 0.0;
  const Vec3 seen = eye.seen(place);
  const Vec3 normal = (is_low(side) ? -1.0 : 1.0) * eye.axes().col(axis);
  return normal.z() - eye.inverse_distance() * normal.dot(seen) > 0.0;
}

// The handle of an edge; absent if it grips no wall.
std::optional<WallGrip::Handle> handle_of(const Edge& edge, const WindowMap& map,
                                          const Snapshot& gas) {
  constexpr float kLeastOutward = 0.2f;  // of the length of a diameter on the viewport
  const Eye& eye = map.eye();
  const VecX room = room_of(gas);
  if (edge.sides.size() == 2 &&
      faces_viewer(eye, room, edge.sides[0]) == faces_viewer(eye, room, edge.sides[1])) {
    return std::nullopt;
  }
  const auto at = [&](const VecX& world) { return map.place(world); };
  const auto a = at(edge.ends[0]), b = at(edge.ends[1]), middle = at(0.5 * room);
  if (!a || !b || !middle) return std::nullopt;
  const ImVec2 along = *b - *a;
  const float length = std::sqrt(dot(along, along));
  if (!(length > 0.0f)) return std::nullopt;
  ImVec2 outward = (1.0f / length) * ImVec2(along.y, -along.x);
  if (dot(*a - *middle, outward) < 0.0f) outward = -1.0f * outward;

  std::optional<WallGrip::Handle> best;
  float most = kLeastOutward * map.units();
  for (const Side side : edge.sides) {
    if (!gas.walls[side]) continue;
    VecX half = VecX::Zero(room.size());
    half[axis_of(side)] = 0.5;
    const VecX centre = 0.5 * (edge.ends[0] + edge.ends[1]);
    const auto low = at(centre - half), high = at(centre + half);
    if (!low || !high) continue;
    const ImVec2 unit = *high - *low;
    const float way = (is_low(side) ? -1.0f : 1.0f) * dot(unit, outward);
    if (way <= most) continue;
    most = way;
    best = {side, {*a, *b}, 1.2f * ImGui::GetFontSize() * outward, unit};
  }
  return best;
}

bool is_over(const WallGrip::Handle& handle, ImVec2 mouse) {
  const ImVec2 along = handle.edge[1] - handle.edge[0], off = mouse - handle.edge[0];
  const float s = dot(off, along) / dot(along, along);
  const float t = dot(off, handle.outward) / dot(handle.outward, handle.outward);
  return s > 0.0f && s < 1.0f && t > 0.0f && t < 1.0f;
}

// The corners of a side in the order of an outline, with the wall at `place` on its axis.
std::vector<VecX> outline(const VecX& box, Side side, double place) {
  const int axis = axis_of(side);
  std::vector<VecX> corners;
  const std::size_t count = box.size() == 2 ? 2 : 4;
  constexpr std::array<int, 4> kInOrder = {0, 1, 3, 2};
  for (std::size_t k = 0; k < count; ++k) {
    VecX corner = box;
    for (int other = 0, bit = 0; other < box.size(); ++other) {
      if (other == axis) continue;
      if (((kInOrder[k] >> bit++) & 1) == 0) corner[other] = 0.0;
    }
    corner[axis] = place;
    corners.push_back(corner);
  }
  return corners;
}

}  // namespace

Area WallGrip::Handle::bounds() const {
  Area area{edge[0], edge[0]};
  for (const ImVec2 corner : {edge[0], edge[1], edge[0] + outward, edge[1] + outward}) {
    area.low = {std::min(area.low.x, corner.x), std::min(area.low.y, corner.y)};
    area.high = {std::max(area.high.x, corner.x), std::max(area.high.y, corner.y)};
  }
  return area;
}

std::vector<WallGrip::Handle> WallGrip::handles(const WindowMap& map, const Frame& frame) {
  std::vector<Handle> handles;
  for (const Edge& edge : edges_of(room_of(frame.snapshot))) {
    if (auto handle = handle_of(edge, map, frame.snapshot)) {
      handles.push_back(*handle);
    }
  }
  return handles;
}

std::optional<WallGrip::Resized> WallGrip::use(const WindowMap& map, const Frame& frame,
                                               bool over) {
  constexpr double kShortest = 4.0;
  constexpr float kClick = 3.0f;  // a shorter motion of the mouse is a click, window units
  const VecX room = room_of(frame.snapshot);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (grip_ && axis_of(grip_->side) >= room.size()) held_ = false;  // the gas became another one
  if (!held_) {
    grip_.reset();
    const std::vector<Handle> near = over ? handles(map, frame) : std::vector<Handle>();
    for (const Handle& handle : near) {
      if (is_over(handle, mouse)) grip_ = handle;
    }
    if (grip_) start_ = length_ = room[axis_of(grip_->side)];
    held_ = grip_ && ImGui::IsMouseClicked(0);
    pushes_ = held_ && grip_->side == kRight && !ImGui::GetIO().KeyShift;
    moved_ = false;
    pressed_ = mouse;
  }
  if (!grip_) return std::nullopt;
  const int axis = axis_of(grip_->side);
  const ImVec2 unit = grip_->unit;
  ImGui::SetMouseCursor(std::fabs(unit.x) > std::fabs(unit.y) ? ImGuiMouseCursor_ResizeEW
                                                              : ImGuiMouseCursor_ResizeNS);
  if (!held_) return std::nullopt;
  const ImVec2 moved = mouse - pressed_;
  moved_ |= std::hypot(moved.x, moved.y) >= kClick;
  const bool low = is_low(grip_->side);
  if (moved_) {
    const double way = dot(moved, unit) / dot(unit, unit);
    length_ = std::max(kShortest, 0.1 * std::round(10.0 * (start_ + (low ? -way : way))));
  }
  if (!ImGui::IsMouseReleased(0)) return std::nullopt;
  held_ = false;
  if (std::exchange(pushes_, false) || start_ == length_) return std::nullopt;
  Resized resized{room, VecX::Zero(room.size())};
  resized.box[axis] = length_;
  if (low) resized.shift[axis] = length_ - start_;
  return resized;
}

std::optional<double> WallGrip::piston() const {
  return pushes_ && moved_ ? std::optional(length_) : std::nullopt;
}

const char* WallGrip::help() const {
  return grip_ && !held_ && grip_->side == kRight
             ? "Drag: moves the wall, a piston, while the gas plays\nShift + drag: resizes the box"
             : nullptr;
}

void WallGrip::mark(ImDrawList& list, const WindowMap& map, const Frame& frame) const {
  const VecX box = room_of(frame.snapshot);
  if (!grip_ || axis_of(grip_->side) >= box.size()) return;
  const int axis = axis_of(grip_->side);
  std::vector<ImVec2> points;
  for (const VecX& end :
       outline(box, grip_->side, is_low(grip_->side) ? box[axis] - length_ : length_)) {
    const auto place = map.place(end);
    if (!place) return;
    points.push_back(*place);
  }
  const float unit = ImGui::GetFontSize();
  list.AddPolyline(points.data(), static_cast<int>(points.size()), packed(accent_colour()),
                   points.size() > 2 ? ImDrawFlags_Closed : 0, 0.2f * unit);
  if (!held_) return;
  const std::string text = fmt::format("{:.1f} a", length_);
  const ImVec2 place = box.size() == 2 ? points.back() : ImGui::GetIO().MousePos;
  const bool sideways = std::fabs(grip_->unit.x) > std::fabs(grip_->unit.y);
  list.AddText(ImVec2(place.x - (sideways ? 4.0f : 5.0f) * unit, place.y - 1.5f * unit),
               ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace clatter
