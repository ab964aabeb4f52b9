#include "render/camera.h"

#include <algorithm>

namespace clatter {

std::string size_text(Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

Camera Camera::fit(const Vec2& low, const Vec2& high, Size size, const Margins& margins) {
  const Vec2 room(std::max(1.0, size.width - margins.left - margins.right),
                  std::max(1.0, size.height - margins.top - margins.bottom));
  const double scale = (room.array() / (high - low).array()).minCoeff();
  const Vec2 off_centre(0.5 * (margins.left - margins.right), 0.5 * (margins.bottom - margins.top));
  return {0.5 * (low + high) - off_centre / scale, size.width / scale};
}

}  // namespace clatter
