#include "app/view/viewport.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/direction.h"
#include "app/view/style.h"
#include "render/picking.h"

namespace clatter {

void Viewport::draw(const Frame& frame, const View& view, Size size, double letters, double least,
                    bool heading) {
  if (!canvas_ || canvas_->size().width != size.width || canvas_->size().height != size.height) {
    canvas_.emplace(*gl_, size);
    stale_ = true;
  }
  const Snapshot& gas = frame.snapshot;
  if (frame.run != run_) {
    run_ = frame.run;
    fits_ = true;
    let_go();
  }
  if (!stale_) return;
  stale_ = false;
  const OverlayText text{heading ? frame.scene->title : "",
                         heading ? frame.scene->caption : "",
                         0.0,
                         letters,
                         least,
                         frame.speed};
  const Legends legends = ranges_.legends(gas, view);
  if (fits_) camera_ = renderer_.fit(gas, size, view, text, legends);
  if (gas.box.size() == 3) {
    camera_.orbit.azimuth = view.azimuth;
    camera_.orbit.elevation = view.elevation;
    camera_.orbit.view_angle = view.view_angle;
  }
  if (follows_ && *picked_ < gas.count()) {
    aim(in_space(gas.positions.col(static_cast<Eigen::Index>(*picked_))));
  }
  canvas_->bind();
  renderer_.draw(gas, camera_, size, view, text, legends);
}

void Viewport::show(int x, int y) const {
  if (canvas_) canvas_->copy_to(0, x, y);
}

void Viewport::fit() {
  fits_ = true;
  follows_ = false;
  stale_ = true;
}

bool Viewport::let_go() {
  const bool had = picked_.has_value();
  picked_.reset();
  follows_ = false;
  return had;
}

void Viewport::aim(const Vec3& centre) {
  camera_.centre = centre.head<2>();
  camera_.orbit.z = centre.z();
}

std::optional<ImVec2> Viewport::picked_place(const Frame& frame, const WindowMap& map) const {
  if (!picked_ || *picked_ >= frame.snapshot.count()) return std::nullopt;
  return map.place(frame.snapshot.positions.col(static_cast<Eigen::Index>(*picked_)));
}

bool Viewport::use_mouse(const Frame& frame, View& view, const WindowMap& map, bool over,
                         bool presses) {
  if (over && ImGui::GetIO().MouseWheel != 0.0f) zoom(frame, map);
  if (over && (ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2))) pan(map);
  return drag_or_click(frame, view, map, over && presses);
}

// The point under the mouse, at the depth of the camera's centre, stays there.
void Viewport::zoom(const Frame& frame, const WindowMap& map) {
  const Vec3& centre = map.eye().centre();
  const Vec3 point = map.world(ImGui::GetIO().MousePos, centre);
  const double factor = std::pow(0.85, ImGui::GetIO().MouseWheel);
  const double wide = frame.snapshot.box.maxCoeff() * 10.0;
  const double width = std::clamp(camera_.width * factor, 2.0, std::max(20.0, wide));
  aim(point + (centre - point) * (width / camera_.width));
  camera_.width = width;
  fits_ = false;
  stale_ = true;
}

void Viewport::pan(const WindowMap& map) {
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  if (moved.x == 0.0f && moved.y == 0.0f) return;
  aim(map.eye().world({-moved.x / map.units(), moved.y / map.units(), 0.0}));
  fits_ = false;
  follows_ = false;
  stale_ = true;
}

// A click picks the particle that was under the mouse at the press. A drag turns spheres, or moves
// the view with Shift.
bool Viewport::drag_or_click(const Frame& frame, View& view, const WindowMap& map, bool over) {
  constexpr float kClick = 3.0f;  // a shorter motion of the mouse is a click, window units
  const ImGuiIO& io = ImGui::GetIO();
  if (over && ImGui::IsMouseClicked(0)) {
    press_ = Press{io.MousePos};
    press_->particle = particle_at(frame.snapshot, map.eye(), map.pixel(io.MousePos), view.slab);
    press_->twice = ImGui::IsMouseDoubleClicked(0);
  }
  if (!press_) return false;
  const float x = io.MousePos.x - press_->place.x, y = io.MousePos.y - press_->place.y;
  press_->dragged |= std::hypot(x, y) >= kClick;
  bool turned = false;
  if (press_->dragged && io.KeyShift) {
    pan(map);
  } else if (press_->dragged && frame.snapshot.box.size() == 3) {
    turned = turn(view, io.MouseDelta.x, io.MouseDelta.y);
  }
  if (ImGui::IsMouseDown(0)) return turned;
  const Press press = *std::exchange(press_, std::nullopt);
  if (press.dragged) return turned;
  picked_ = press.particle;
  follows_ = picked_ && (press.twice || follows_);
  if (follows_) fits_ = false;
  stale_ = true;
  return turned;
}

void Viewport::mark(ImDrawList& list, const Frame& frame, const WindowMap& map) const {
  const Snapshot& gas = frame.snapshot;
  const auto ring = [&](const VecX& position, ImU32 ink) {
    const auto outline = map.outline(position, 0.5 * gas.diameter);
    if (outline) list.AddCircle(outline->centre, outline->radius + 2.0f, ink, 0, 2.5f);
  };
  if (picked_ && *picked_ < gas.count()) {
    ring(gas.positions.col(static_cast<Eigen::Index>(*picked_)), packed(accent_colour()));
  }
  if (!frame.partners) return;
  // The pair touches, if need be across a periodic border.
  const auto [first, second] = *frame.partners;
  if (std::max(first, second) >= gas.count()) return;
  constexpr ImU32 kPair = IM_COL32(255, 214, 90, 255);
  ring(gas.positions.col(first), kPair);
  ring(nearest_image(gas, gas.positions.col(first), gas.positions.col(second)), kPair);
}

}  // namespace clatter
