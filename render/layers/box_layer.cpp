#include "render/layers/box_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "render/layers/wall_layer.h"

namespace clatter {

namespace {

// Positions of the sides of the box at the time of the snapshot: the faces of the walls.
std::array<Vec3, 2> box_corners(const Snapshot& snapshot) {
  Vec3 low = Vec3::Zero(), high = snapshot.box;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] += snapshot.wall_displacement[2 * axis];
    high[axis] -= snapshot.wall_displacement[2 * axis + 1];
  }
  return {low, high};
}

Rectangle3 side_of(const Snapshot& snapshot, int side) {
  const auto [low, high] = box_corners(snapshot);
  const int axis = side / 2;
  const auto [first, second] = others_of(axis);
  return {axis, (side % 2 ? high : low)[axis], Vec2(low[first], low[second]),
          Vec2(high[first], high[second])};
}

// Whether the inner face of a side is turned to the viewer.
bool faces_viewer(const Snapshot& snapshot, int side, const Eye& eye) {
  const int axis = side / 2;
  const Vec3 towards = eye.axes().row(2);
  double viewer = towards[axis] > 0.0 ? HUGE_VAL : -HUGE_VAL;
  if (eye.inverse_distance() > 0.0) {
    viewer = eye.centre()[axis] + towards[axis] / eye.inverse_distance();
  }
  const double face = side_of(snapshot, side).position;
  return side % 2 ? viewer < face : viewer > face;
}

}  // namespace

SidePattern side_pattern(WallKind kind) {
  switch (kind) {
    case WallKind::Static:
      return SidePattern::Hatch;
    case WallKind::Driven:
    case WallKind::Sawtooth:
      return SidePattern::Rings;
    case WallKind::Sinusoidal:
      return SidePattern::Waves;
    case WallKind::Thermal:
      return SidePattern::Glow;
  }
  return SidePattern::Hatch;
}

double ring_advance(const Wall& wall, double time, double period) {
  if (wall.kind != WallKind::Driven) return 0.0;
  const double periods = 0.5 * wall.drive_speed * time / period;
  return periods - std::floor(periods);
}

BoxLayer::BoxLayer(const Gl& gl) : gl_(&gl), faces_(gl, "side.frag"), lines_(gl) {}

void BoxLayer::draw_sides(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const WallColours& colours) const {
  const Program& program = faces_.use(snapshot.box, projection, eye);
  gl_->DepthMask(GL_FALSE);
  for (int side = 0; side < 6; ++side) {
    const std::optional<Wall>& wall = snapshot.walls[side];
    if (!wall || !faces_viewer(snapshot, side, eye)) continue;
    const Rectangle3 rectangle = side_of(snapshot, side);
    const Vec2 extent = rectangle.high - rectangle.low;
    const double period = std::max(1.0, 0.08 * extent.minCoeff());
    gl_->Uniform1i(program.uniform("u_pattern"), static_cast<GLint>(side_pattern(wall->kind)));
    gl_->Uniform2f(program.uniform("u_extent"), extent.x(), extent.y());
    gl_->Uniform1f(program.uniform("u_advance"), -ring_advance(*wall, snapshot.time, period));
    set_colour(*gl_, program, "u_colour", colours.of(*wall));
    faces_.draw(rectangle, eye, extent);
  }
  gl_->DepthMask(GL_TRUE);
}

void BoxLayer::draw_edges(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const WallColours& colours, Sides sides) {
  const double width =
      projection.samples *
      std::max(1.0, 0.0016 * std::min(projection.size.width, projection.size.height));
  // The edges of each side have its colour. Walls are drawn over periodic borders.
  for (const bool walls : {false, true}) {
    std::vector<Line> lines;
    for (int side = 0; side < 6; ++side) {
      const std::optional<Wall>& wall = snapshot.walls[side];
      if (wall.has_value() != walls) continue;
      const bool far = faces_viewer(snapshot, side, eye);
      if (sides != Sides::All && far != (sides == Sides::Far)) continue;
      const Rectangle3 rectangle = side_of(snapshot, side);
      const std::array<Vec2, 4> corners = {
          rectangle.low, Vec2(rectangle.high.x(), rectangle.low.y()), rectangle.high,
          Vec2(rectangle.low.x(), rectangle.high.y())};
      const Colour colour = wall ? colours.of(*wall) : colours.theme.static_wall;
      for (std::size_t k = 0; k < 4; ++k) {
        lines.push_back({place_in(rectangle, corners[k]), place_in(rectangle, corners[(k + 1) % 4]),
                         width, colour});
      }
    }
    lines_.draw(lines, snapshot.box, projection, eye, walls ? 0.0 : 10.0 * width);
  }
}

}  // namespace clatter
