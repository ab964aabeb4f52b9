#include "render/layers/fixture_layer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "render/fixture_images.h"
#include "render/layers/wall_layer.h"

namespace clatter {

namespace {

// Must match fixture.frag.
enum class Mark { Plain, Teeth, Hatch, Glow };
constexpr double kToothLength = 0.75;  // of the thickness of the band

Mark mark_of(WallKind kind) {
  if (kind == WallKind::Thermal) return Mark::Glow;
  return kind == WallKind::Driven ? Mark::Teeth : Mark::Hatch;
}

double outline_width(const Projection& projection) {
  return projection.samples * std::max(1.0, std::round(wall_thickness(projection.size) / 10.0));
}

std::vector<Vec2> corners_of(const Obstacle& obstacle) {
  if (obstacle.kind == ObstacleKind::Polygon) return obstacle.corners;
  const Vec2 from = obstacle.from, to = obstacle.to;
  return {from, {to.x(), from.y()}, to, {from.x(), to.y()}};
}

double area_of(const std::vector<Vec2>& corners) {
  double area = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return std::fabs(area);
}

double outline_of(const std::vector<Vec2>& corners) {
  double length = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    length += (corners[(k + 1) % corners.size()] - corners[k]).norm();
  }
  return length;
}

std::array<float, 4> floats(const Vec2& a, const Vec2& b) {
  return {static_cast<float>(a.x()), static_cast<float>(a.y()), static_cast<float>(b.x()),
          static_cast<float>(b.y())};
}

}  // namespace

FixtureLayer::FixtureLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "fixture.vert", "fixture.frag"),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      corners_texture_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindVertexArray(vertices_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  const auto attribute = [&](GLuint index, GLint size, std::size_t offset, GLenum type = GL_FLOAT) {
    gl.VertexAttribPointer(index, size, type, type != GL_FLOAT, sizeof(Body),
                           reinterpret_cast<const void*>(offset));
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribDivisor(index, 1);
  };
  attribute(0, 4, offsetof(Body, rectangle));
  attribute(1, 4, offsetof(Body, shape));
  attribute(2, 4, offsetof(Body, marks));
  attribute(3, 2, offsetof(Body, counts));
  attribute(4, 4, offsetof(Body, fill), GL_UNSIGNED_BYTE);
  attribute(5, 4, offsetof(Body, colour), GL_UNSIGNED_BYTE);
  gl.BindTexture(GL_TEXTURE_2D, corners_texture_.id());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

// The look of a fixture by its law. A whole number of teeth fits around its outline.
FixtureLayer::Body FixtureLayer::body_of(const FixtureLaw& law, const Snapshot& snapshot,
                                         const Projection& projection, const WallColours& colours,
                                         double thickness, double outline) const {
  const Wall wall = law.wall();
  const double teeth = std::max(1.0, std::round(outline / (2.0 * thickness)));
  double periods = 0.0;
  if (wall.kind == WallKind::Driven) {
    // As of walls, see WallLayer.
    periods =
        0.5 * wall.drive_speed * snapshot.time * projection.scale() / (kToothLength * thickness);
  }
  Body body{};
  body.marks = {static_cast<float>(mark_of(wall.kind)), static_cast<float>(thickness),
                static_cast<float>(outline / teeth),
                static_cast<float>(periods - std::floor(periods))};
  body.fill = {0, 0, 0, 0};
  body.colour = colours.of(wall);
  return body;
}

// Adds a closed polygon, by pixels from its origin.
void FixtureLayer::add_corners(const std::vector<Vec2>& corners, const Vec2& origin, double scale) {
  double along = 0.0;
  for (std::size_t k = 0; k <= corners.size(); ++k) {
    const Vec2& corner = corners[k % corners.size()];
    if (k > 0) along += scale * (corner - corners[k - 1]).norm();
    const Vec2 place = scale * (corner - origin);
    corners_.push_back(floats(place, Vec2(along, 0.0)));
  }
}

// Adds a body and its images on the repeated axes. `low` and `high` are its bounds in world units.
void FixtureLayer::add_images(Body body, const Vec2& origin, const Vec2& low, const Vec2& high,
                              const Snapshot& snapshot, const Projection& projection,
                              const Extent& extent, const std::array<bool, 2>& repeated) {
  const auto shifts = [&](int axis) {
    return image_shifts({low[axis], high[axis]}, snapshot.box[axis], repeated[axis],
                        {extent.low[axis], extent.high[axis]});
  };
  const auto [left, right] = shifts(0);
  const auto [lowest, highest] = shifts(1);
  for (int y = lowest; y <= highest; ++y) {
    for (int x = left; x <= right; ++x) {
      const Vec2 shift = snapshot.box.cwiseProduct(Vec2(x, y));
      const Vec2 place = projection.pixels(origin + shift);
      body.rectangle = floats(projection.pixels((low + shift).cwiseMax(extent.low)),
                              projection.pixels((high + shift).cwiseMin(extent.high)));
      body.shape[0] = static_cast<float>(place.x());
      body.shape[1] = static_cast<float>(place.y());
      bodies_.push_back(body);
    }
  }
}

void FixtureLayer::add_obstacle(const Obstacle& obstacle, const Snapshot& snapshot,
                                const Projection& projection, const WallColours& colours,
                                const Extent& extent) {
  const double scale = projection.scale(), pixel = 1.0 / scale;
  const bool ball = obstacle.kind == ObstacleKind::Ball;
  const std::vector<Vec2> corners = ball ? std::vector<Vec2>() : corners_of(obstacle);
  Vec2 origin = obstacle.centre, low = origin, high = origin;
  double area = std::numbers::pi * obstacle.radius * obstacle.radius;
  double outline = 2.0 * std::numbers::pi * obstacle.radius;
  if (ball) {
    low.array() -= obstacle.radius;
    high.array() += obstacle.radius;
  } else {
    origin = low = high = corners.front();
    for (const Vec2& corner : corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    area = area_of(corners);
    outline = outline_of(corners);
  }
  // A small body has a thin band.
  const double thickness =
      std::min(projection.samples * wall_thickness(projection.size), 1.2 * area / outline * scale);
  Body body = body_of(obstacle.law, snapshot, projection, colours, thickness, outline * scale);
  constexpr double kFill = 0.3;
  body.fill = mix(colours.theme.background, body.colour, kFill);
  body.shape[2] = static_cast<float>(ball ? obstacle.radius * scale : 0.0);
  body.shape[3] = static_cast<float>(corners_.size());
  body.counts[0] = static_cast<float>(corners.size());
  if (!ball) add_corners(corners, origin, scale);
  const Vec2 edge = Vec2::Constant(pixel);
  add_images(body, origin, low - edge, high + edge, snapshot, projection, extent,
             {!snapshot.walls[kLeft], !snapshot.walls[kBottom]});
}

void FixtureLayer::add_partition(const Partition& partition, const Snapshot& snapshot,
                                 const Projection& projection, const WallColours& colours,
                                 const Extent& extent) {
  constexpr double kWidth = 2.5;  // of outlines
  const int across = static_cast<int>(partition.axis), along = 1 - across;
  const double scale = projection.scale();
  const double width = kWidth * outline_width(projection);
  const double thickness = 0.6 * projection.samples * wall_thickness(projection.size);
  // The ends at walls and edges of the picture are outside of the drawn extent.
  const double reach = (thickness + width) / scale;
  const std::array<double, 2> drawn = {extent.low[along] - reach, extent.high[along] + reach};
  const auto add = [&](double from, double to, bool valve) {
    const double thin = valve ? width / kWidth : width;
    Vec2 low, high;
    low[across] = partition.position - 0.5 * thin / scale;
    high[across] = partition.position + 0.5 * thin / scale;
    low[along] = from;
    high[along] = to;
    const double outline = 2.0 * ((to - from) * scale + width);
    Body body = body_of(partition.law, snapshot, projection, colours, thickness, outline);
    if (partition.law.wall().kind == WallKind::Static) {
      body.marks[0] = static_cast<float>(Mark::Plain);
    }
    body.marks[3] = 1.0f - body.marks[3];  // away from the line
    if (valve) body.marks[0] = static_cast<float>(Mark::Plain);
    if (valve || !partition.passes.empty()) {
      body.counts[1] = static_cast<float>((along == 0 ? 4.0 : -4.0) * width);
    }
    const std::vector<Vec2> corners = {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
    body.shape[3] = static_cast<float>(corners_.size());
    body.counts[0] = 4.0f;
    add_corners(corners, low, scale);
    std::array<bool, 2> repeated = {false, false};
    repeated[across] = !snapshot.walls[2 * across];
    add_images(body, low, low.array() - reach, high.array() + reach, snapshot, projection, extent,
               repeated);
  };
  for (const auto& [from, to] : closed_segments(partition, snapshot, drawn)) add(from, to, false);
  for (const Hole& hole : partition.holes) {
    if (!hole.valve) continue;
    const double period = snapshot.box[along];
    const auto [first, last] =
        image_shifts({hole.from[0], hole.to[0]}, period, !snapshot.walls[2 * along], drawn);
    for (int shift = first; shift <= last; ++shift) {
      add(hole.from[0] + shift * period, hole.to[0] + shift * period, true);
    }
  }
}

void FixtureLayer::upload_corners() {
  constexpr std::size_t kColumns = 1024;
  corners_.resize(std::max<std::size_t>(1, (corners_.size() + kColumns - 1) / kColumns) * kColumns);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, corners_texture_.id());
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kColumns,
                  static_cast<GLsizei>(corners_.size() / kColumns), 0, GL_RGBA, GL_FLOAT,
                  corners_.data());
}

void FixtureLayer::draw(const Snapshot& snapshot, const Projection& projection,
                        const WallColours& colours, const Tiling& tiling) {
  const Faces faces = faces_of(snapshot);
  Extent extent{faces.low, faces.high};
  for (const int axis : {0, 1}) {
    if (snapshot.walls[2 * axis]) continue;
    extent.low[axis] = tiling.low(snapshot.box)[axis] - 0.5 * snapshot.diameter;
    extent.high[axis] = tiling.high(snapshot.box)[axis] + 0.5 * snapshot.diameter;
  }
  bodies_.clear();
  corners_.clear();
  for (const Obstacle& obstacle : snapshot.obstacles) {
    add_obstacle(obstacle, snapshot, projection, colours, extent);
  }
  for (const Partition& partition : snapshot.partitions) {
    add_partition(partition, snapshot, projection, colours, extent);
  }
  upload_corners();

  const Size drawn = projection.drawn();
  const Vec2 low = projection.pixels(faces.low), high = projection.pixels(faces.high);
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform1i(program_.uniform("u_corners"), 0);
  gl_->Uniform1f(program_.uniform("u_line"), outline_width(projection));
  gl_->Uniform2f(program_.uniform("u_box_low"), low.x(), low.y());
  gl_->Uniform2f(program_.uniform("u_box_high"), high.x(), high.y());
  gl_->Uniform1f(program_.uniform("u_faintness"), tiling.faintness);
  gl_->BindVertexArray(vertices_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, bodies_.size() * sizeof(Body), bodies_.data(), GL_STREAM_DRAW);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(bodies_.size()));
}

}  // namespace clatter
