#include "app/view/viewport.h"

#include <algorithm>
#include <cmath>

#include "app/view/style.h"

namespace clatter {

void Viewport::draw(const Frame& frame, const View& view, Size size, double letters) {
  if (!canvas_ || canvas_->size().width != size.width || canvas_->size().height != size.height) {
    canvas_.emplace(*gl_, size);
    stale_ = true;
  }
  if (frame.run != run_) {
    run_ = frame.run;
    fits_ = true;
    let_go();
  }
  if (!stale_) return;
  stale_ = false;
  const OverlayText text{frame.scene->title, frame.scene->caption, 0.0, letters};
  if (fits_) camera_ = renderer_.fit(frame.snapshot, size, view, text);
  if (follows_ && *picked_ < frame.snapshot.count()) {
    camera_.centre = frame.snapshot.positions.col(*picked_);
  }
  canvas_->bind();
  renderer_.draw(frame.snapshot, camera_, size, view, text);
}

void Viewport::show(int x, int y) const {
  if (canvas_) canvas_->show(x, y);
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

Vec2 Viewport::world(ImVec2 mouse, ImVec2 corner, float scale) const {
  const Size size = canvas_->size();
  const Vec2 pixel((mouse.x - corner.x) * scale, size.height - (mouse.y - corner.y) * scale);
  return camera_.centre +
         (pixel - 0.5 * Vec2(size.width, size.height)) / Projection{camera_, size}.scale();
}

ImVec2 Viewport::place(const Vec2& world, ImVec2 corner, float scale) const {
  const Vec2 pixel = Projection{camera_, canvas_->size()}.pixels(world);
  return {corner.x + static_cast<float>(pixel.x()) / scale,
          corner.y + static_cast<float>(canvas_->size().height - pixel.y()) / scale};
}

std::optional<ImVec2> Viewport::picked_place(const Frame& frame, ImVec2 corner, float scale) const {
  if (!canvas_ || !picked_ || *picked_ >= frame.snapshot.count()) return std::nullopt;
  return place(frame.snapshot.positions.col(*picked_), corner, scale);
}

std::optional<std::size_t> Viewport::disk_at(const Frame& frame, const Vec2& point) const {
  const auto& positions = frame.snapshot.positions;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    if ((positions.col(i) - point).norm() < 0.5 * frame.snapshot.diameter) return i;
  }
  return std::nullopt;
}

void Viewport::use_mouse(const Frame& frame, ImVec2 corner, float scale) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!canvas_) return;
  if (io.MouseWheel != 0.0f) {
    const Vec2 point = world(io.MousePos, corner, scale);
    const double factor = std::pow(0.85, io.MouseWheel);
    const double wide = std::max(frame.snapshot.box.x(), frame.snapshot.box.y()) * 10.0;
    const double width = std::clamp(camera_.width * factor, 2.0, std::max(20.0, wide));
    camera_.centre = point + (camera_.centre - point) * (width / camera_.width);
    camera_.width = width;
    fits_ = false;
    stale_ = true;
  }
  const bool drags = ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
  if (drags && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
    const double unit = scale / Projection{camera_, canvas_->size()}.scale();
    camera_.centre += Vec2(-io.MouseDelta.x, io.MouseDelta.y) * unit;
    fits_ = false;
    follows_ = false;
    stale_ = true;
  }
  if (ImGui::IsMouseClicked(0)) {
    picked_ = disk_at(frame, world(io.MousePos, corner, scale));
    follows_ = picked_ && (ImGui::IsMouseDoubleClicked(0) || follows_);
    if (follows_) fits_ = false;
    stale_ = true;
  }
}

void Viewport::mark(ImDrawList& list, const Frame& frame, ImVec2 corner, float scale) const {
  if (!canvas_) return;
  const float radius = static_cast<float>(0.5 * frame.snapshot.diameter *
                                          Projection{camera_, canvas_->size()}.scale()) /
                       scale;
  const auto ring = [&](std::uint32_t disk, ImU32 ink) {
    if (disk >= frame.snapshot.count()) return;
    list.AddCircle(place(frame.snapshot.positions.col(disk), corner, scale), radius + 2.0f, ink, 0,
                   2.5f);
  };
  if (picked_) ring(*picked_, packed(accent_colour()));
  if (!frame.partners) return;
  for (const std::uint32_t disk : *frame.partners) ring(disk, IM_COL32(255, 214, 90, 255));
}

}  // namespace clatter
