#pragma once

#include <imgui.h>

#include <optional>

#include "render/eye.h"

namespace clatter {

/// The mapping between the world and the window for one picture. World positions have the dimension
/// of the gas; disks are seen from the front.
class WindowMap {
 public:
  /// A circle of the window, in window units.
  struct Circle {
    ImVec2 centre;
    float radius;
  };

  /// The upper left corner of a picture is at `corner` in window units. `scale` is the number of
  /// pixels per window unit.
  WindowMap(const Camera& camera, Size size, ImVec2 corner, float scale)
      : eye_(Projection{camera, size}), height_(size.height), corner_(corner), scale_(scale) {}

  /// The mapping from the world to pixels.
  const Eye& eye() const { return eye_; }
  /// Pixel at a position of the window.
  Vec2 pixel(ImVec2 place) const;
  /// Position in the window of a pixel.
  ImVec2 of_pixel(const Vec2& pixel) const;
  /// Position in the window of a world position; absent: behind the viewer.
  std::optional<ImVec2> place(const VecX& world) const;
  /// World position at a position of the window, at the depth of another world position.
  Vec3 world(ImVec2 place, const Vec3& deep) const;
  /// The outline in the window of a sphere in the world; absent: behind the viewer.
  std::optional<Circle> outline(const VecX& world, double radius) const;
  /// Window units per world unit at the centre of the view.
  float units() const { return static_cast<float>(eye_.scale()) / scale_; }

 private:
  Eye eye_;
  int height_;
  ImVec2 corner_;
  float scale_;
};

}  // namespace clatter
