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

Vec3 WindowMap::world(ImVec2 place, const Vec3& deep) const {
  const Vec3 seen = eye_.seen(deep);
  const Vec2 off = (pixel(place) - eye_.origin()) * eye_.w(seen) / eye_.scale();
  return eye_.world({off.x(), off.y(), seen.z()});
}

std::optional<WindowMap::Circle> WindowMap::outline(const VecX& world, double radius) const {
  const Vec3 seen = eye_.seen(in_space(world));
  if (eye_.w(seen + Vec3(0.0, 0.0, radius)) < Eye::kNearest) return std::nullopt;
  const auto [low, high] = eye_.around(seen, radius);
  const double size = 0.5 * (high - low).maxCoeff() / scale_;
  return Circle{of_pixel(0.5 * (low + high)), static_cast<float>(size)};
}

}  // namespace clatter
