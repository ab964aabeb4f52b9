#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "render/camera.h"
#include "render/palette.h"

namespace clatter {

/// How much of each pixel small disks of one radius cover, and with how much light of which colour.
/// What a disk adds is its area times its colour in linear light, whatever its place.
class Coverage {
 public:
  /// Pixels kept around the picture, for disks whose centre lies just outside.
  static constexpr int kMargin = 4;
  /// Particles are smaller than this, pixels.
  static constexpr double kLargestRadius = 1.5;

  /// Starts an empty picture of `size`, for disks of `radius` > 0, in pixels.
  void restart(Size size, double radius);
  /// Adds a share of a disk, whose centre is in pixels from the picture's lower left corner and at
  /// most kMargin - 2 pixels outside.
  void add(const Vec2& centre, Colour colour, float share = 1.0f);
  /// Sums up what the disks added since restart() give to each pixel.
  void sum();

  /// The extent with the margin on every side.
  Size extent() const { return {size_.width + 2 * kMargin, size_.height + 2 * kMargin}; }
  /// The sum, [height][width] of extent(), from below: red, green and blue light, and area, in
  /// pixels.
  const std::vector<Eigen::Array4f>& pixels() const { return pixels_; }

 private:
  static constexpr int kPhases = 16;  // places of a disk in its pixel that are told apart, per axis
  static constexpr int kSide = 4;     // pixels that such a disk reaches, per axis
  using Stencil = std::array<float, kSide * kSide>;  // [y][x]: area of the disk in each pixel

  struct Disk {
    float x, y;  // lower left corner of the square about it, pixels of extent()
    Colour colour;
    float share;
  };

  Stencil stencil(double x, double y) const;
  void add_to_pixels(const Disk& disk);

  Size size_;
  double radius_ = 0.0;
  int side_ = 0;                          // of the stencils' part that may hold area
  std::vector<Stencil> stencils_;         // [phase of y][phase of x]
  std::vector<std::vector<Disk>> bands_;  // by height, so that a band's pixels stay in the cache
  std::vector<Eigen::Array4f> pixels_;
};

}  // namespace clatter
