#include "app/view/window_map.h"

#include "render/picking.h"

namespace clatter {

Vec2 WindowMap::pixel(ImVec2 place) const {
  return {(place.x - corner_.x) * scale_, height_ - (place.y - corner_.y) * scale_};
}

ImVec2 WindowMap::of_pixel(const Vec2& pixel) const {
  return {corner_.x + static_cast<float>(pixel.x()) / scale_,
          corner_.y + static_cast<float>(height_ - pixel.y()) / scale_};
}

std::optional<ImVec2> WindowMap::place(const VecX& world) const {
  const Vec3 seen = eye_.seen(in_space(world));
  if (eye_.w(seen) < Eye::kNearest) return std::nullopt;
  return of_pixel(eye_.pixels(seen));
}

}  // namespace clatter
