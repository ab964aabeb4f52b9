#pragma once

#include <cstdint>
#include <vector>

#include "render/camera.h"

namespace clatter {

/// Finds disks on a picture that nearer disks hide completely, several of them together too. It has
/// a bit for each pixel: whether a disk covers its centre. All lengths are in pixels.
class Occlusion {
 public:
  /// An empty picture of `size`.
  explicit Occlusion(Size size);

  /// Whether all pixels with their centre in a disk are covered. Pixels outside of the picture do
  /// not count.
  bool hides(const Vec2& centre, double radius) const;
  /// Covers the pixels with their centre in a disk.
  void cover(const Vec2& centre, double radius);

 private:
  static constexpr int kBits = 64;  // pixels in a word

  template <class Visit>
  bool all_words(const Vec2& centre, double radius, Visit visit) const;

  Size size_;
  std::size_t words_;                   // in a row
  std::vector<std::uint64_t> covered_;  // [rows][words]
};

}  // namespace clatter
