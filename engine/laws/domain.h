#pragma once

#include <array>
#include <cmath>

#include "engine/vec.h"

namespace clatter {

/// The space of a gas: a box, and its periodic images along axes without walls. An image is
/// given by whole numbers of box lengths, 0 along axes with walls.
template <int D>
struct Domain {
  Vec<D> box = Vec<D>::Zero();     ///< edge lengths
  std::array<bool, D> periodic{};  ///< by axis; false: two walls

  /// The image that contains a position.
  [[gnu::always_inline]] Vec<D> image_at(const Vec<D>& position) const {
    Vec<D> image = Vec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) {
      const bool inside = position[axis] >= 0.0 && position[axis] < box[axis];
      if (inside || !periodic[axis]) continue;
      image[axis] = std::floor(position[axis] / box[axis]);
    }
    return image;
  }
  /// The displacement of an image from the box.
  Vec<D> shift(const Vec<D>& image) const { return image.cwiseProduct(box); }
  /// The place in the box of a position in any image.
  Vec<D> wrapped(const Vec<D>& position) const { return position - shift(image_at(position)); }
  /// The shortest way between the images of two points, from any way between them.
  Vec<D> shortest(Vec<D> way) const {
    for (int axis = 0; axis < D; ++axis) {
      if (periodic[axis]) way[axis] -= box[axis] * std::round(way[axis] / box[axis]);
    }
    return way;
  }
};

}  // namespace clatter
