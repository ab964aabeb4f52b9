#pragma once

#include <array>
#include <span>

#include "render/camera.h"

namespace clatter {

using Vec3 = Vec<3>;

/// A viewer of spheres. View coordinates are in world units: x to the right, y up, z towards the
/// viewer, with the origin at the centre of the camera.
///
/// A point (x, y, z) has w = 1 - z/d, where d is the distance of the viewer, and appears at
/// s (x, y)/w from the pixel of the centre. At the centre s pixels are a world unit. In a parallel
/// projection d is infinite and w = 1. The depth z/w grows towards the viewer, and is linear along
/// straight lines of the picture.
class Eye {
 public:
  /// Least w of drawn points: nearer to the viewer than this share of his distance is nothing.
  static constexpr double kNearest = 0.02;

  /// The viewer of a projection. `diameter` is that of the largest spheres.
  explicit Eye(const Projection& projection, double diameter = 1.0);

  /// View coordinates of a world position.
  Vec3 seen(const Vec3& world) const { return axes_ * (world - centre_); }
  /// World position of view coordinates.
  Vec3 world(const Vec3& seen) const { return centre_ + axes_.transpose() * seen; }
  /// The rotation from the world to the view; its rows are the axes of the view in the world.
  const Eigen::Matrix3d& axes() const { return axes_; }
  /// World position of the origin of the view.
  const Vec3& centre() const { return centre_; }
  /// World position of the viewer; only with inverse_distance() > 0.
  Vec3 viewer() const { return world(Vec3(0.0, 0.0, 1.0 / inverse_distance_)); }
  /// 1/d, 0 in a parallel projection.
  double inverse_distance() const { return inverse_distance_; }
  /// w of a position in view coordinates; 0 or less at or behind the viewer.
  double w(const Vec3& seen) const { return 1.0 - seen.z() * inverse_distance_; }
  /// Radius on the picture of a sphere around a position, in drawn pixels.
  double pixels(const Vec3& seen, double radius) const { return radius * scale_ / w(seen); }
  /// Drawn pixel of a position in view coordinates with w > 0.
  Vec2 pixels(const Vec3& seen) const { return origin_ + scale_ / w(seen) * seen.head<2>(); }
  /// Lower left and upper right corner of the smallest rectangle around a sphere on the picture, in
  /// drawn pixels. `seen` is its centre in view coordinates; the viewer is outside of the sphere.
  std::array<Vec2, 2> around(const Vec3& seen, double radius) const;
  /// Largest |z/w| in a box from the origin and one diameter around it: the scale of depths.
  double depth_range(const Vec3& box) const;
  /// Drawn pixel of the centre.
  const Vec2& origin() const { return origin_; }
  /// Drawn pixels per world unit at the centre.
  double scale() const { return scale_; }

 private:
  Vec3 centre_;
  Eigen::Matrix3d axes_;
  double inverse_distance_;
  double diameter_;
  Vec2 origin_;
  double scale_;
};

/// The camera with these angles that shows all `points` inside the margins of a picture of `size`,
/// as large as possible. Its centre is `centre`.
Camera fit_orbit(const Vec3& centre, std::span<const Vec3> points, Orbit angles, Size size,
                 const Margins& margins);

}  // namespace clatter
