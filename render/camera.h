#pragma once

#include <string>

#include "engine/vec.h"

namespace clatter {

/// A picture's extent in pixels.
struct Size {
  int width = 0;
  int height = 0;

  bool operator==(const Size&) const = default;
};

/// Passes over all members, in order, for checkpoints.
/// As people write it: "1280x720".
std::string size_text(Size size);

template <class Archive>
void visit(Archive& io, Size& size) {
  auto& [width, height] = size;
  io(width, height);
}

/// Space along the edges of a picture, in pixels.
struct Margins {
  double left = 0.0;
  double right = 0.0;
  double top = 0.0;
  double bottom = 0.0;
};

/// What part of the world a picture shows.
struct Camera {
  Vec2 centre = {0.0, 0.0};  ///< world point in the middle of the picture
  double width = 1.0;        ///< world units across the whole picture

  /// The camera that shows the rectangle from `low` to `high` as large as the margins of a picture
  /// of `size` allow, in the middle of what they leave.
  static Camera fit(const Vec2& low, const Vec2& high, Size size, const Margins& margins);
};

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, Camera& camera) {
  auto& [centre, width] = camera;
  io(centre, width);
}

/// From the world to the pixels that are drawn: x to the right, y up, from the lower left corner.
struct Projection {
  Camera camera;
  Size size;        ///< of the finished picture
  int samples = 1;  ///< drawn along each axis for one pixel of the finished picture

  /// The extent of what is drawn.
  Size drawn() const { return {samples * size.width, samples * size.height}; }
  /// How many pixels a world unit takes.
  double scale() const { return drawn().width / camera.width; }
  /// Exact in double, so that single precision does for the result.
  Vec2 pixels(const Vec2& world) const {
    return (world - camera.centre) * scale() + 0.5 * Vec2(drawn().width, drawn().height);
  }
};

}  // namespace clatter
