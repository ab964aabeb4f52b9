#include "app/view/picture_mouse.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "app/view/controls.h"
#include "app/view/lecture.h"
#include "app/view/mouse_tools.h"
#include "app/view/style.h"
#include "app/view/viewport.h"
#include "engine/physics/theory.h"
#include "engine/scene/act_checks.h"
#include "engine/scene/key_writer.h"

namespace clatter {

static double few_digits(double number) {
  return std::stod(fmt::format("{:.6g}", number));
}

// The innermost position for the hand, which compresses the gas to a share of the closest packing.
static double innermost(const Scene& scene) {
  constexpr double kShare = 0.9, kAbove = 1.001;
  const double packed =
      scene.box[0] * scene.packing_fraction() / (kShare * closest_packing(scene.dimension()));
  return std::max(packed, kAbove * least_piston_position(scene));
}

void PistonHand::use(Session& session, std::optional<double> wanted) {
  if (drag_ && drag_->run != session.frame().run) drag_.reset();
  if (drag_ && !wanted) release(session);
  if (!wanted) return;
  if (!drag_) drag_ = Drag{session.frame().run, {}};
  push(session, *wanted);
}

// A stroke begins where and when the one before ends. It is sent a little earlier.
void PistonHand::push(Session& session, double wanted) {
  constexpr double kStroke = 0.1, kLead = 0.04;  // seconds of playing
  constexpr double kSlowest = 0.05;              // box lengths per second of playing
  const Frame& frame = session.frame();
  if (!frame.plays || frame.backwards || !session.is_answered()) return;
  const Snapshot& gas = frame.snapshot;
  const PistonPlan plan =
      piston_plan(frame.scene->changes, gas.time, gas.box[0] - gas.piston_travel);
  if (plan.time > gas.time + kLead * frame.speed) return;
  const double duration = few_digits(kStroke * frame.speed);
  const double fastest = std::max(std::sqrt(gas.temperature), kSlowest * gas.box[0] / frame.speed);
  const double way = fastest * duration;
  const double lowest = std::min(innermost(session.scene()), plan.position);
  const double position = few_digits(
      std::clamp(std::clamp(wanted, plan.position - way, plan.position + way), lowest, gas.box[0]));
  if (position == few_digits(plan.position)) return;
  session.move_piston(position, duration);
  drag_->acts.push_back({.piston = position});
}

void PistonHand::release(Session& session) {
  Drag drag = *std::exchange(drag_, std::nullopt);
  if (!drag.acts.empty()) return session.remember({.acts = std::move(drag.acts)});
  if (!session.frame().plays) {
    session.report("The piston moves while the gas plays; Shift + drag makes another box");
  }
}

PictureMouse::PictureMouse(const WindowParts& parts, LectureMode& lecture)
    : log_(parts.log),
      session_(parts.session),
      controls_(parts.controls),
      viewport_(parts.viewport),
      mouse_tools_(parts.mouse_tools),
      lecture_(lecture) {}

void PictureMouse::use(ImVec2 corner, float scale) {
  const Frame& frame = session_.frame();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const Area cell = viewport_.cell(corner, scale);
  const bool over = contains(cell, mouse) && !ImGui::GetIO().WantCaptureMouse;
  const WindowMap map = viewport_.map(corner, scale);
  if (log_.on()) log_handles(map);
  mouse_tools_.use(session_, map, over);
  const bool free = !mouse_tools_.active() && !lecture_.draws();
  if (const auto resized = wall_grip_.use(map, frame, over && free)) {
    controls_.set({{"box.size", value_text(session_.scene().box)}},
                  {{"box.size", value_text(resized->box)}}, resized->shift);
  }
  piston_hand_.use(session_, wall_grip_.piston());
  if (const char* help = wall_grip_.help()) ImGui::SetTooltip("%s", help);
  View view = session_.view();
  lecture_.use_pen(over);
  const bool turned = viewport_.use_mouse(
      frame, view, map, over && !lecture_.draws() && !wall_grip_.active(), !mouse_tools_.active());
  controls_.show(view, turned);
  session_.pick(viewport_.picked());

  // A zoom has changed the mapping.
  const WindowMap now = viewport_.map(corner, scale);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(cell.low, cell.high);
  wall_grip_.mark(list, now, frame);
  viewport_.mark(list, frame, now);
  mouse_tools_.mark(list, frame, now);
  lecture_.paint_ink(list, over);
  list.PopClipRect();
  if (const auto place = viewport_.picked_place(frame, now)) {
    particle_label(frame, *viewport_.picked(), viewport_.follows(), *place, cell);
  }
  use_cells(corner, scale);
}

// A click on the cell of another gas selects it. The selected one has a frame.
void PictureMouse::use_cells(ImVec2 corner, float scale) {
  const std::size_t gases = viewport_.cells();
  if (gases == 1) return;
  const bool clicks = ImGui::IsMouseClicked(0) && !ImGui::GetIO().WantCaptureMouse;
  for (std::size_t gas = 0; gas < gases; ++gas) {
    const Area cell = viewport_.cell(corner, scale, gas);
    if (clicks && contains(cell, ImGui::GetIO().MousePos)) session_.select(gas);
    log_.widget(std::string("cell.") + static_cast<char>('a' + gas), cell.low.x, cell.low.y,
                cell.high.x - cell.low.x, cell.high.y - cell.low.y);
  }
  const Area selected = viewport_.cell(corner, scale);
  ImGui::GetBackgroundDrawList()->AddRect(selected.low, selected.high, packed(accent_colour()));
}

// Logs the longest handle of each wall.
void PictureMouse::log_handles(const WindowMap& map) const {
  std::array<float, 6> longest{};
  std::array<Area, 6> areas;
  for (const auto& handle : WallGrip::handles(map, session_.frame())) {
    const auto [a, b] = handle.edge;
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    if (length <= longest[handle.side]) continue;
    longest[handle.side] = length;
    areas[handle.side] = handle.bounds();
  }
  for (std::size_t side = 0; side < longest.size(); ++side) {
    if (longest[side] == 0.0f) continue;
    const auto& [low, high] = areas[side];
    log_.widget(std::string("wall.") + kSideNames[side], low.x, low.y, high.x - low.x,
                high.y - low.y);
  }
}

}  // namespace clatter
