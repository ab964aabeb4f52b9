#include "render/layers/coverage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace clatter {

static constexpr int kBandHeight = 16;  // pixels

void Coverage::restart(Size size, double radius) {
  assert(radius < kLargestRadius);
  size_ = size;
  pixels_.assign(static_cast<std::size_t>(extent().width) * extent().height,
                 Eigen::Array4f::Zero());
  bands_.resize(extent().height / kBandHeight + 1);
  for (std::vector<Disk>& band : bands_) band.clear();
  if (radius == radius_) return;
  radius_ = radius;
  levels_ = {};
  prepare(levels_.back(), radius);
}

void Coverage::prepare(Level& level, double radius) const {
  level.radius = radius;
  level.side = static_cast<int>(2.0 * radius + (kPhases - 0.5) / kPhases) + 1;
  for (int y = 0; y < kPhases; ++y) {
    for (int x = 0; x < kPhases; ++x) {
      level.stencils.push_back(
          stencil(radius, radius + (x + 0.5) / kPhases, radius + (y + 0.5) / kPhases));
    }
  }
}

// Pixel areas of the disk at (x, y), integrated over horizontal chords.
Coverage::Stencil Coverage::stencil(double radius, double x, double y) const {
  constexpr int kChords = 64;
  Stencil areas{};
  double sum = 0.0;
  for (int k = 0; k < kChords; ++k) {
    const double share = (2.0 * k + 1.0) / kChords - 1.0;
    const int row = static_cast<int>(y + share * radius);
    const double half = radius * std::sqrt(1.0 - share * share);
    sum += 2.0 * half;
    for (int column = 0; column < kSide; ++column) {
      const double length = std::min(x + half, column + 1.0) - std::max(x - half, column + 0.0);
      areas[row * kSide + column] += static_cast<float>(std::max(0.0, length));
    }
  }
  const double area = std::numbers::pi * radius * radius;
  for (float& part : areas) part *= static_cast<float>(area / sum);
  return areas;
}

// A disk has the stencil of the next larger radius, with the light of its own area.
void Coverage::add(const Vec2& centre, Colour colour, float share, double relative) {
  int number = kLevels - 1;
  if (relative < 1.0) {
    number = std::max(static_cast<int>(std::ceil(relative * kLevels)), 1) - 1;
    const double larger = (number + 1.0) / kLevels;
    share *= static_cast<float>(relative * relative / (larger * larger));
    Level& level = levels_[static_cast<std::size_t>(number)];
    if (level.stencils.empty()) prepare(level, larger * radius_);
  }
  const Vec2 corner = centre.array() - levels_[static_cast<std::size_t>(number)].radius + kMargin;
  bands_[static_cast<std::size_t>(corner.y()) / kBandHeight].push_back(
      {static_cast<float>(corner.x()),
       static_cast<float>(corner.y()),
       {colour.red, colour.green, colour.blue},
       static_cast<std::uint8_t>(number),
       share});
}

void Coverage::sum() {
  for (const std::vector<Disk>& band : bands_) {
    for (const Disk& disk : band) {
      add_to_pixels(disk,
                    [](Eigen::Array4f& pixel, const Eigen::Array4f& light) { pixel += light; });
    }
  }
}

void Coverage::compose(float shade) {
  const Eigen::Array4f shades(shade, shade, shade, 1.0f);
  for (const std::vector<Disk>& band : bands_) {
    for (const Disk& disk : band) {
      add_to_pixels(disk, [&](Eigen::Array4f& pixel, const Eigen::Array4f& light) {
        pixel += std::max(0.0f, 1.0f - pixel[3]) * shades * light;
      });
    }
  }
}

// Calls `lay` with each pixel and the disk's light and area in it.
template <class Lay>
void Coverage::add_to_pixels(const Disk& disk, Lay lay) {
  const int x = static_cast<int>(disk.x), y = static_cast<int>(disk.y);
  const int phase_x = static_cast<int>((disk.x - x) * kPhases);
  const int phase_y = static_cast<int>((disk.y - y) * kPhases);
  const Level& level = levels_[disk.level];
  const Stencil& areas = level.stencils[phase_y * kPhases + phase_x];
  const Eigen::Array4f light =
      disk.share * Eigen::Array4f(linear_light(disk.colour.red), linear_light(disk.colour.green),
                                  linear_light(disk.colour.blue), 1.0f);
  Eigen::Array4f* row = &pixels_[static_cast<std::size_t>(y) * extent().width + x];
  for (int j = 0; j < level.side; ++j, row += extent().width) {
    for (int i = 0; i < level.side; ++i) lay(row[i], areas[j * kSide + i] * light);
  }
}

}  // namespace clatter
