#include "render/eye.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter {

static double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}

static Eigen::Matrix3d axes_of(const Orbit& orbit) {
  const double azimuth = radians(orbit.azimuth), elevation = radians(orbit.elevation);
  const double sin_a = std::sin(azimuth), cos_a = std::cos(azimuth);
  const double sin_e = std::sin(elevation), cos_e = std::cos(elevation);
  Eigen::Matrix3d axes;
  axes << cos_a, 0.0, -sin_a,                 // right
      -sin_a * sin_e, cos_e, -cos_a * sin_e,  // up
      sin_a * cos_e, sin_e, cos_a * cos_e;    // to the viewer
  return axes;
}

// 1/d in picture widths: the viewer sees half the width under half the angle.
static double widths_per_distance(const Orbit& orbit) {
  return 2.0 * std::tan(0.5 * radians(orbit.view_angle));
}

Eye::Eye(const Projection& projection, double diameter)
    : centre_(projection.camera.centre.x(), projection.camera.centre.y(),
              projection.camera.orbit.z),
      axes_(axes_of(projection.camera.orbit)),
      inverse_distance_(widths_per_distance(projection.camera.orbit) / projection.camera.width),
      diameter_(diameter),
      origin_(0.5 * Vec2(projection.drawn().width, projection.drawn().height) +
              projection.camera.orbit.shift * projection.drawn().width),
      scale_(projection.scale()) {}

std::array<Vec2, 2> Eye::around(const Vec3& seen, double radius) const {
  std::array<Vec2, 2> corners;
  const double near = w(seen);
  for (const int axis : {0, 1}) {
    double low = seen[axis] - radius, high = seen[axis] + radius;
    if (inverse_distance_ > 0.0) {
      // Tangents from the viewer in the plane of this axis, with lengths in distances of the
      // viewer.
      const double x = seen[axis] * inverse_distance_, r = radius * inverse_distance_;
      const double below = (near * near - r * r) * inverse_distance_;
      const double root = r * std::sqrt(x * x + near * near - r * r);
      low = (x * near - root) / below;
      high = (x * near + root) / below;
    }
    corners[0][axis] = origin_[axis] + scale_ * low;
    corners[1][axis] = origin_[axis] + scale_ * high;
  }
  return corners;
}

double Eye::depth_range(const Vec3& box) const {
  const double radius = box.norm() + 2.0 * diameter_ + (centre_ - 0.5 * box).norm();
  if (inverse_distance_ == 0.0) return radius;
  const double front = std::min(radius, (1.0 - kNearest) / inverse_distance_);
  return std::max(radius, front / (1.0 - front * inverse_distance_));
}

Camera fit_orbit(const Vec3& centre, std::span<const Vec3> points, Orbit angles, Size size,
                 const Margins& margins) {
  const Vec2 room(std::max(1.0, size.width - margins.left - margins.right),
                  std::max(1.0, size.height - margins.top - margins.bottom));
  const Eigen::Matrix3d axes = axes_of(angles);
  const double tilt = widths_per_distance(angles);
  // |x| s/w = |x| (W/width) / (1 - z tilt/width) is at most half the room.
  double width = 0.0;
  for (const Vec3& point : points) {
    const Vec3 seen = axes * (point - centre);
    for (const int axis : {0, 1}) {
      width =
          std::max(width, 2.0 * size.width * std::fabs(seen[axis]) / room[axis] + tilt * seen.z());
    }
  }
  angles.z = centre.z();
  angles.shift =
      Vec2(0.5 * (margins.left - margins.right), 0.5 * (margins.bottom - margins.top)) / size.width;
  return {centre.head<2>(), width, angles};
}

}  // namespace clatter
