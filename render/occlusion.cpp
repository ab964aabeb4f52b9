#include "render/occlusion.h"

#include <algorithm>
#include <cmath>

namespace clatter {

// Blocks of a third of the radius are small against a disk; smaller ones cost more than they hide.
Occlusion::Occlusion(Size size, double radius)
    : block_(std::max(2, static_cast<int>(std::min(radius / 3.0, 64.0)))),
      columns_((size.width + block_ - 1) / block_),
      rows_((size.height + block_ - 1) / block_),
      covered_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

bool Occlusion::hides(const Vec2& low, const Vec2& high) const {
  const auto index = [&](double place, int count) {
    return static_cast<int>(std::clamp(std::floor(place / block_), 0.0, count - 1.0));
  };
  const int right = index(high.x(), columns_), top = index(high.y(), rows_);
  for (int row = index(low.y(), rows_); row <= top; ++row) {
    for (int column = index(low.x(), columns_); column <= right; ++column) {
      if (!covered_[static_cast<std::size_t>(row) * columns_ + column]) return false;
    }
  }
  return true;
}

void Occlusion::cover(const Vec2& centre, double radius) {
  const int bottom = std::max(0, static_cast<int>(std::ceil((centre.y() - radius) / block_)));
  const int top = std::min(rows_, static_cast<int>(std::floor((centre.y() + radius) / block_)));
  for (int row = bottom; row < top; ++row) {
    // The half chord at the edge of the row that is farther from the centre.
    const double off = std::max(centre.y() - row * block_, (row + 1) * block_ - centre.y());
    const double square = radius * radius - off * off;
    if (square <= 0.0) continue;
    const double half = std::sqrt(square);
    const int left = std::max(0, static_cast<int>(std::ceil((centre.x() - half) / block_)));
    const int right =
        std::min(columns_, static_cast<int>(std::floor((centre.x() + half) / block_)));
    for (int column = left; column < right; ++column) {
      covered_[static_cast<std::size_t>(row) * columns_ + column] = true;
    }
  }
}

}  // namespace clatter
