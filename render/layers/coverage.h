#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "render/camera.h"
#include "render/palette.h"

namespace clatter {

/// Area and light that small disks add to each pixel. The total light of a disk is its area times
/// its colour in linear light, at any position.
class Coverage {
 public:
  /// Width of the margin around the picture in pixels, for disks with their centre just outside.
  static constexpr int kMargin = 4;
  /// Upper limit of the radius in pixels, exclusive.
  static constexpr double kLargestRadius = 1.5;

  /// Starts an empty picture of `size`, for disks of at most `radius` pixels, 0 < radius <
  /// kLargestRadius.
  void restart(Size size, double radius);
  /// Adds the fraction `share` of a disk. `centre` is in pixels from the lower left corner of the
  /// picture, at most kMargin - 2 pixels outside. `relative` is the radius over the largest one, at
  /// most 1.
  void add(const Vec2& centre, Colour colour, float share = 1.0f, double relative = 1.0);
  /// Computes pixels() from the disks added since restart(), which do not overlap.
  void sum();
  /// Computes pixels() from disks that may overlap and were added from front to back. The covered
  /// share of a pixel hides the same share of each disk behind. `shade` multiplies all light.
  void compose(float shade);

  /// Size of the picture with its margins.
  Size extent() const { return {size_.width + 2 * kMargin, size_.height + 2 * kMargin}; }
  /// Red, green and blue light and covered area of each pixel; a full pixel has area 1. Shape
  /// [height][width] of extent(), lowest row first.
  const std::vector<Eigen::Array4f>& pixels() const { return pixels_; }

 private:
  static constexpr int kPhases = 16;  // resolved positions of a disk in its pixel, per axis
  static constexpr int kSide = 4;     // largest number of pixels that a disk covers, per axis
  static constexpr int kLevels = 32;  // resolved radii
  using Stencil = std::array<float, kSide * kSide>;  // [y][x]: area of the disk in each pixel

  // Stencils of one radius; empty: not used yet.
  struct Level {
    double radius = 0.0;
    int side = 0;                   // used side of the stencils
    std::vector<Stencil> stencils;  // [phase of y][phase of x]
  };

  struct Disk {
    float x, y;  // lower left corner of its bounding square, pixels of extent()
    Rgb colour;
    std::uint8_t level;  // of its radius
    float share;
  };

  void prepare(Level& level, double radius) const;
  Stencil stencil(double radius, double x, double y) const;
  template <class Lay>
  void add_to_pixels(const Disk& disk, Lay lay);

  Size size_;
  double radius_ = 0.0;
  std::array<Level, kLevels> levels_;     // of equal steps of the radius; the last has the largest
  std::vector<std::vector<Disk>> bands_;  // disks sorted by row, to avoid cache misses in pixels_
  std::vector<Eigen::Array4f> pixels_;
};

}  // namespace clatter
