#include "app/view/fixture_edits.h"

#include <algorithm>
#include <cmath>

#include "engine/laws/fixture.h"

namespace clatter {

namespace {

constexpr double kReach = 0.5;  // of the mouse, diameters

double to_hundredths(double number) {
  return std::round(100.0 * number) / 100.0;
}

Vec2 rounded_place(const Vec2& place) {
  return {to_hundredths(place.x()), to_hundredths(place.y())};
}

bool is_on(const Partition& partition, const Vec2& place) {
  return std::fabs(place[static_cast<int>(partition.axis)] - partition.position) < kReach;
}

// The part of a line between two places. An end near a side of the box is on it.
Hole part_between(double from, double to, double side) {
  double low = to_hundredths(std::min(from, to)), high = to_hundredths(std::max(from, to));
  if (low < kReach) low = 0.0;
  if (high > side - kReach) high = side;
  return {{low}, {high}};
}

}  // namespace

Scene with_ball(Scene scene, const Vec2& from, const Vec2& to) {
  constexpr double kRim = 0.7, kLeast = 0.1;  // of the radius; radius
  for (Obstacle& ball : scene.obstacles) {
    if (ball.kind != ObstacleKind::Ball || !ball.present) continue;
    const Vec2 centre = ball.centre;
    if ((from - centre).norm() > ball.radius + kReach) continue;
    if ((from - centre).norm() < kRim * ball.radius) {
      ball.centre = rounded_place(centre + to - from);
    } else {
      ball.radius = std::max(kLeast, to_hundredths((to - centre).norm()));
    }
    return scene;
  }
  Obstacle& ball = scene.obstacles.emplace_back();
  ball.centre = rounded_place(from);
  ball.from = ball.to = Vec2::Zero();
  ball.radius = std::max(kLeast, to_hundredths((to - from).norm()));
  return scene;
}

Scene with_wall(Scene scene, const Vec2& from, const Vec2& to) {
  const Vec2 way = (to - from).cwiseAbs();
  const int along = way.y() > way.x() ? 1 : 0, across = 1 - along;
  for (Partition& wall : scene.partitions) {
    if (!wall.present || !is_on(wall, from)) continue;
    if (static_cast<int>(wall.axis) == across) {
      wall.holes.push_back(part_between(from[along], to[along], scene.box[along]));
    } else {
      wall.position = to_hundredths(to[static_cast<int>(wall.axis)]);
    }
    return scene;
  }
  Partition& wall = scene.partitions.emplace_back();
  wall.axis = static_cast<Axis>(across);
  wall.position = to_hundredths(from[across]);
  const double side = scene.box[along];
  const Hole closed = part_between(from[along], to[along], side);
  if (scene.periodic(along)) return scene;
  if (closed.from[0] > 0.0) wall.holes.push_back({{0.0}, closed.from});
  if (closed.to[0] < side) wall.holes.push_back({closed.to, {side}});
  return scene;
}

std::optional<Scene> without_fixture_at(Scene scene, const Vec2& place) {
  const std::vector<Fixture<2>> fixtures = fixtures_of<2>(scene);
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    if (fixtures[k].pieces.empty() || distance_from<2>(fixtures[k], place) > 0.0) continue;
    scene.obstacles.erase(scene.obstacles.begin() + static_cast<std::ptrdiff_t>(k));
    return scene;
  }
  for (std::size_t k = 0; k < scene.partitions.size(); ++k) {
    if (!scene.partitions[k].present || !is_on(scene.partitions[k], place)) continue;
    scene.partitions.erase(scene.partitions.begin() + static_cast<std::ptrdiff_t>(k));
    return scene;
  }
  return std::nullopt;
}

}  // namespace clatter
