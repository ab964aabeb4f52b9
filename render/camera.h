#pragma once

#include <string>

#include "engine/vec.h"

namespace clatter {

/// Size of a picture in pixels.
struct Size {
  int width = 0;
  int height = 0;

  bool operator==(const Size&) const = default;
};

/// A size as text, "1280x720".
std::string size_text(Size size);

/// Passes over all members, in order, for checkpoints.
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

/// The third dimension of a camera: the view of a box of spheres. All angles are in degrees.
struct Orbit {
  double z = 0.0;           ///< third component of the camera's centre
  double azimuth = 0.0;     ///< direction to the viewer, about the y axis; 0 is z, 90 is x
  double elevation = 0.0;   ///< direction to the viewer, above the xz plane, -90..90
  double view_angle = 0.0;  ///< horizontal angle of view, 0..120; 0: a parallel projection
  Vec2 shift = {0.0, 0.0};  ///< of the centre from the middle of the picture, in its widths
};

/// The part of the world that a picture shows.
struct Camera {
  Vec2 centre = {0.0, 0.0};  ///< world position of the middle of the picture
  double width = 1.0;        ///< width of the picture in world units, at the centre
  Orbit orbit = {};          ///< of spheres

  /// The camera that fits the rectangle from `low` to `high` into a picture of `size` without its
  /// margins, centred and as large as possible.
  static Camera fit(const Vec2& low, const Vec2& high, Size size, const Margins& margins);
};

/// Passes over all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, Camera& camera) {
  auto& [centre, width, orbit] = camera;
  io(centre, width, orbit.z, orbit.azimuth, orbit.elevation, orbit.view_angle, orbit.shift);
}

/// Mapping from world coordinates to drawn pixels: x to the right, y up, origin at the lower left
/// corner.
struct Projection {
  Camera camera;
  Size size;        ///< size of the finished picture
  int samples = 1;  ///< drawn pixels per finished pixel, along each axis

  /// Size in drawn pixels.
  Size drawn() const { return {samples * size.width, samples * size.height}; }
  /// Drawn pixels per world unit.
  double scale() const { return drawn().width / camera.width; }
  /// Drawn pixel of a world position, in double precision. Single precision suffices for the
  /// result.
  Vec2 pixels(const Vec2& world) const {
    return (world - camera.centre) * scale() + 0.5 * Vec2(drawn().width, drawn().height);
  }
};

}  // namespace clatter
