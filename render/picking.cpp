#include "render/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/bodies.h"
#include "render/drawn_region.h"

namespace clatter {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A part of a ray, by its parameter.
struct Interval {
  double first, last;
};

// The ray through a pixel, in world coordinates. The parameter grows away from the viewer.
struct Ray {
  Vec3 origin, along;
  double begin;  // nearer parts are not drawn

  Ray(const Eye& eye, const Vec2& pixel) {
    const Vec2 place = (pixel - eye.origin()) / eye.scale();
    const Vec3 seen =
        Vec3(place.x() * eye.inverse_distance(), place.y() * eye.inverse_distance(), -1.0)
            .normalized();
    origin = eye.world({place.x(), place.y(), 0.0});
    along = eye.axes().transpose() * seen;
    const double per_distance = -seen.z() * eye.inverse_distance();
    begin = per_distance > 0.0 ? (Eye::kNearest - 1.0) / per_distance : -kInfinity;
  }

  Interval inside(const DrawnRegion& region) const {
    Interval part{begin, kInfinity};
    for (int axis = 0; axis < 3; ++axis) {
      const double low = region.low[axis] - origin[axis], high = region.high[axis] - origin[axis];
      if (along[axis] != 0.0) {
        const auto [near, far] = std::minmax({low / along[axis], high / along[axis]});
        part = {std::max(part.first, near), std::min(part.last, far)};
      } else if (low > 0.0 || high < 0.0) {
        part.last = -kInfinity;
      }
    }
    return part;
  }

  // Where the ray enters the part of a sphere in `drawn`; infinite: nowhere.
  double enters(const Vec3& centre, double radius, const Interval& drawn) const {
    const Vec3 away = origin - centre;
    const double middle = -away.dot(along);
    const double chord = radius * radius - (away.squaredNorm() - middle * middle);
    if (!(chord > 0.0)) return kInfinity;
    const double first = std::max(middle - std::sqrt(chord), drawn.first);
    const double last = std::min(middle + std::sqrt(chord), drawn.last);
    return first <= last ? first : kInfinity;
  }
};

std::optional<std::size_t> disk_at(const Snapshot& snapshot, const Vec2& point) {
  for (Eigen::Index i = 0; i < snapshot.positions.cols(); ++i) {
    const auto number = static_cast<std::size_t>(i);
    if ((snapshot.positions.col(i) - point).norm() < snapshot.radius(number)) return number;
  }
  return std::nullopt;
}

}  // namespace

Vec3 in_space(const VecX& position) {
  return {position.x(), position.y(), position.size() == 3 ? position.z() : 0.0};
}

VecX nearest_image(const Snapshot& snapshot, const VecX& position, const VecX& particle) {
  VecX image = particle;
  if (snapshot.slide != 0.0 || snapshot.offset != 0.0) {
    image[0] -= snapshot.offset * std::round((particle[1] - position[1]) / snapshot.box[1]);
  }
  for (int axis = 0; axis < position.size(); ++axis) {
    if (snapshot.walls[2 * axis]) continue;
    const double length = snapshot.box[axis];
    image[axis] -= length * std::round((image[axis] - position[axis]) / length);
  }
  return image;
}

std::optional<std::size_t> particle_at(const Snapshot& snapshot, const Eye& eye, const Vec2& pixel,
                                       const std::optional<Slab>& slab) {
  const Ray ray(eye, pixel);
  if (snapshot.box.size() == 2) return disk_at(snapshot, ray.origin.head<2>());
  for (const bool periodic_faces : {true, false}) {
    const Interval drawn = ray.inside(drawn_region(snapshot, slab, periodic_faces));
    std::optional<std::size_t> front;
    double nearest = kInfinity;
    for (std::size_t i = 0; i < snapshot.count(); ++i) {
      const Vec3 position = snapshot.positions.col(static_cast<Eigen::Index>(i));
      const double radius = snapshot.radius(i);
      visit_images(snapshot, position, radius, [&](const Vec3& place) {
        const double entry = ray.enters(place, radius, drawn);
        if (entry >= nearest) return;
        nearest = entry;
        front = i;
      });
    }
    if (!front) continue;
    const bool hidden = bodies_of(snapshot, slab).hide(ray.origin + nearest * ray.along, eye);
    return hidden ? std::nullopt : front;
  }
  return std::nullopt;
}

}  // namespace clatter
