#include "render/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/fixture_images.h"

namespace clatter {

namespace {

// A part of a ray, by shares of the way to the viewer.
struct Stretch {
  double from, to;

  bool empty() const { return !(from < to); }
};

Stretch between(const Vec3& start, const Vec3& way, const Vec3& low, const Vec3& high) {
  Stretch inside{-HUGE_VAL, HUGE_VAL};
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0) {
      if (start[axis] < low[axis] || start[axis] > high[axis]) return {0.0, 0.0};
      continue;
    }
    const double a = (low[axis] - start[axis]) / way[axis];
    const double b = (high[axis] - start[axis]) / way[axis];
    inside = {std::max(inside.from, std::min(a, b)), std::min(inside.to, std::max(a, b))};
  }
  return inside;
}

Stretch in_ball(const Vec3& start, const Vec3& way, const Bodies::Ball& ball) {
  const Vec3 away = start - ball.centre;
  const double a = way.squaredNorm(), b = way.dot(away);
  const double root = b * b - a * (away.squaredNorm() - ball.radius * ball.radius);
  if (!(root > 0.0)) return {0.0, 0.0};
  return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
}

// Calls `visit` with the shift of each image of a body that reaches into the box.
template <class Visit>
void visit_shifts(const Snapshot& snapshot, const Vec3& low, const Vec3& high, Visit visit) {
  std::array<std::array<int, 2>, 3> shifts;
  for (int axis = 0; axis < 3; ++axis) {
    shifts[axis] = image_shifts({low[axis], high[axis]}, snapshot.box[axis],
                                !snapshot.walls[2 * axis], {0.0, snapshot.box[axis]});
  }
  for (int z = shifts[2][0]; z <= shifts[2][1]; ++z) {
    for (int y = shifts[1][0]; y <= shifts[1][1]; ++y) {
      for (int x = shifts[0][0]; x <= shifts[0][1]; ++x) {
        visit(Vec3(snapshot.box.cwiseProduct(Vec3(x, y, z))));
      }
    }
  }
}

}  // namespace

bool Bodies::hide(const Vec3& position, const Eye& eye) const {
  if (balls.empty() && blocks.empty()) return false;
  const bool parallel = eye.inverse_distance() == 0.0;
  const Vec3 way = parallel ? Vec3(eye.axes().row(2)) : Vec3(eye.viewer() - position);
  const Stretch seen{0.0, parallel ? HUGE_VAL : 1.0};
  const auto meets = [&](const Stretch& a, const Stretch& b) {
    return !Stretch{std::max({a.from, b.from, seen.from}), std::min({a.to, b.to, seen.to})}.empty();
  };
  const Stretch drawn = between(position, way, region.low, region.high);
  return std::ranges::any_of(
             balls, [&](const Ball& ball) { return meets(in_ball(position, way, ball), drawn); }) ||
         std::ranges::any_of(blocks, [&](const Block& block) {
           return meets(between(position, way, block.low, block.high), drawn);
         });
}

DrawnRegion fixture_region(const Snapshot& snapshot, const std::optional<Slab>& slab) {
  DrawnRegion region = drawn_region(snapshot, slab, true);
  for (int axis = 0; axis < 3; ++axis) {
    region.low[axis] = std::max(region.low[axis], snapshot.wall_displacement[2 * axis]);
    region.high[axis] =
        std::min(region.high[axis], snapshot.box[axis] - snapshot.wall_displacement[2 * axis + 1]);
  }
  return region;
}

Bodies bodies_of(const Snapshot& snapshot, const std::optional<Slab>& slab) {
  Bodies bodies{fixture_region(snapshot, slab), {}, {}};
  const Vec3 low = bodies.region.low, high = bodies.region.high;
  for (std::size_t k = 0; k < snapshot.obstacles.size(); ++k) {
    const Obstacle& obstacle = snapshot.obstacles[k];
    if (obstacle.kind == ObstacleKind::Ball) {
      const Vec3 centre = obstacle.centre, reach = Vec3::Constant(obstacle.radius);
      visit_shifts(snapshot, centre - reach, centre + reach, [&](const Vec3& shift) {
        bodies.balls.push_back({centre + shift, obstacle.radius, k});
      });
    } else {
      const Vec3 from = obstacle.from, to = obstacle.to;
      visit_shifts(snapshot, from, to, [&](const Vec3& shift) {
        const Bodies::Block block{(from + shift).cwiseMax(low), (to + shift).cwiseMin(high), k};
        if ((block.low.array() < block.high.array()).all()) bodies.blocks.push_back(block);
      });
    }
  }
  return bodies;
}

}  // namespace clatter
