#include "render/layers/sphere_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/drawn_region.h"
#include "render/layers/face_layer.h"

namespace clatter {

namespace {

// Whether a slice is between a position and the viewer.
bool hides(const Slice& slice, const Vec3& position, const Vec3& box, const Eye& eye) {
  const bool parallel = eye.inverse_distance() == 0.0;
  const Vec3 way = parallel ? Vec3(eye.axes().row(2)) : Vec3(eye.viewer() - position);
  const auto axis = static_cast<int>(slice.axis);
  const double share = (slice.position - position[axis]) / way[axis];
  if (!(share > 0.0) || (!parallel && share > 1.0)) return false;
  const Vec3 meeting = position + share * way;
  return std::ranges::all_of(others_of(axis), [&](int other) {
    return meeting[other] > 0.0 && meeting[other] < box[other];
  });
}

// Mean light on the visible half of a sphere without neighbours, relative to its colour. Must match
// sphere.frag.
float mean_light(const Eye& eye) {
  constexpr int kPoints = 64;  // along each axis
  const Vec3 key(-0.40, 0.62, 0.675), up = eye.axes().col(1);
  double sum = 0.0;
  int count = 0;
  for (int j = 0; j < kPoints; ++j) {
    for (int i = 0; i < kPoints; ++i) {
      const double x = (2 * i + 1.0) / kPoints - 1.0, y = (2 * j + 1.0) / kPoints - 1.0;
      if (x * x + y * y >= 1.0) continue;
      const Vec3 normal(x, y, std::sqrt(1.0 - x * x - y * y));
      sum += 0.3 + 0.3 * (0.5 + 0.5 * normal.dot(up)) + 0.8 * std::max(normal.dot(key), 0.0);
      ++count;
    }
  }
  return static_cast<float>(sum / count);
}

}  // namespace

bool SphereLight::draws(const Eye& eye, const Snapshot& snapshot) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
    const Vec3 seen = eye.seen(share.cwiseProduct(Vec3(snapshot.box)));
    if (eye.w(seen) > 0.0 && draws(eye, seen, 0.5 * snapshot.diameter)) return true;
  }
  return false;
}

void SphereLight::draw(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                       const DiskColours& colours, const std::optional<Slab>& slab,
                       std::span<const Slice> slices, const Bodies& bodies) {
  collect(snapshot, projection, eye, slab, slices, bodies);
  if (small_.empty()) return;
  sort();
  const float largest = std::ranges::max(small_, {}, &Small::radius).radius;
  coverage_.restart(projection.drawn(), largest);
  const bool alike = snapshot.grains.empty();
  for (const Small& sphere : sorted_) {
    const Colour colour = colours.of(snapshot, sphere.number);
    const float share = sphere.radius / largest;
    if (alike) {
      // A more distant sphere is drawn wider and fainter.
      coverage_.add({sphere.x, sphere.y}, colour, share * share);
    } else {
      coverage_.add({sphere.x, sphere.y}, colour, 1.0f, share);
    }
  }
  coverage_.compose(mean_light(eye));
  gl_->Disable(GL_DEPTH_TEST);
  const Faces everywhere{Vec2::Constant(-1e9), Vec2::Constant(1e9)};
  light_.draw(coverage_, projection, everywhere, 1.0f, colours.blending);
  gl_->Enable(GL_DEPTH_TEST);
}

void SphereLight::collect(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const std::optional<Slab>& slab, std::span<const Slice> slices,
                          const Bodies& bodies) {
  const double largest = 0.5 * snapshot.diameter;
  const Vec2 high(projection.drawn().width + Coverage::kLargestRadius,
                  projection.drawn().height + Coverage::kLargestRadius);
  const DrawnRegion region = drawn_region(snapshot, slab, true);
  const Vec3 box = snapshot.box;
  small_.clear();
  for (std::size_t i = 0; i < snapshot.count(); ++i) {
    const Vec3 position = snapshot.positions.col(static_cast<Eigen::Index>(i));
    const Vec3 seen = eye.seen(position);
    if (eye.w(seen) < Eye::kNearest || !draws(eye, seen, largest)) continue;
    const Vec2 centre = eye.pixels(seen);
    if ((centre.array() < -Coverage::kLargestRadius).any() ||
        (centre.array() > high.array()).any() || region.cuts(position, 0.0)) {
      continue;
    }
    const auto hidden = [&](const Slice& slice) { return hides(slice, position, box, eye); };
    if (std::ranges::any_of(slices, hidden) || bodies.hide(position, eye)) continue;
    small_.push_back({static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                      static_cast<float>(eye.pixels(seen, snapshot.radius(i))),
                      static_cast<float>(-seen.z()), static_cast<std::uint32_t>(i)});
  }
}

// From front to back, by counting in equal parts of the distance. The order in a part is that of
// the numbers.
void SphereLight::sort() {
  constexpr std::size_t kParts = 1 << 16;
  const auto [nearest, farthest] = std::ranges::minmax(small_, {}, &Small::distance);
  const double least = nearest.distance, range = farthest.distance - least;
  const auto part = [&](const Small& sphere) {
    if (!(range > 0.0)) return std::size_t{0};
    return static_cast<std::size_t>((sphere.distance - least) / range * (kParts - 1));
  };
  std::vector<std::uint32_t> next(kParts + 1, 0);
  for (const Small& sphere : small_) ++next[part(sphere) + 1];
  for (std::size_t k = 1; k <= kParts; ++k) next[k] += next[k - 1];
  sorted_.resize(small_.size());
  for (const Small& sphere : small_) sorted_[next[part(sphere)]++] = sphere;
}

}  // namespace clatter
