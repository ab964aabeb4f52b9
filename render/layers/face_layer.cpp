#include "render/layers/face_layer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "render/layers/sphere_layer.h"
#include "render/layers/wall_layer.h"

namespace clatter {

namespace {

// The other two axes, in order.
std::array<int, 2> others_of(int axis) {
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

Vec3 place_in(const Rectangle3& rectangle, const Vec2& place) {
  const auto [first, second] = others_of(rectangle.axis);
  Vec3 position;
  position[rectangle.axis] = rectangle.position;
  position[first] = place.x();
  position[second] = place.y();
  return position;
}

// Positions of the sides of the box at the time of the snapshot: the faces of the walls.
std::array<Vec3, 2> corners_of(const Snapshot& snapshot) {
  Vec3 low = Vec3::Zero(), high = snapshot.box;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] += snapshot.wall_displacement[2 * axis];
    high[axis] -= snapshot.wall_displacement[2 * axis + 1];
  }
  return {low, high};
}

Rectangle3 side_of(const Snapshot& snapshot, int side) {
  const auto [low, high] = corners_of(snapshot);
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

// Must match side.frag.
enum Pattern { kHatch, kRings, kWaves, kGlow };

Pattern pattern_of(WallKind kind) {
  switch (kind) {
    case WallKind::Static:
      return kHatch;
    case WallKind::Driven:
    case WallKind::Sawtooth:
      return kRings;
    case WallKind::Sinusoidal:
      return kWaves;
    case WallKind::Thermal:
      return kGlow;
  }
  return kHatch;
}

}  // namespace

FaceLayer::FaceLayer(const Gl& gl, const char* fragment_file)
    : gl_(&gl),
      program_(gl, "face.vert", fragment_file),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(vertices_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 5 * sizeof(float), nullptr);
  gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, 5 * sizeof(float),
                         reinterpret_cast<const void*>(3 * sizeof(float)));
  gl.EnableVertexAttribArray(0);
  gl.EnableVertexAttribArray(1);
}

const Program& FaceLayer::use(const Projection& projection, const Eye& eye,
                              double depth_range) const {
  const Size drawn = projection.drawn();
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform2f(program_.uniform("u_origin"), eye.origin().x(), eye.origin().y());
  gl_->Uniform1f(program_.uniform("u_scale"), eye.scale());
  gl_->Uniform1f(program_.uniform("u_inverse_distance"), eye.inverse_distance());
  gl_->Uniform1f(program_.uniform("u_depth_range"), depth_range);
  return program_;
}

void FaceLayer::draw(const Rectangle3& rectangle, const Eye& eye, const Vec2& place) const {
  std::array<float, 20> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 share(k % 2, k / 2);
    const Vec2 at = rectangle.low + share.cwiseProduct(rectangle.high - rectangle.low);
    const Vec3 seen = eye.seen(place_in(rectangle, at));
    for (int i = 0; i < 3; ++i) corners[5 * k + i] = static_cast<float>(seen[i]);
    for (int i = 0; i < 2; ++i) corners[5 * k + 3 + i] = static_cast<float>(share[i] * place[i]);
  }
  gl_->BindVertexArray(vertices_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, sizeof corners, corners.data(), GL_STREAM_DRAW);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

BoxLayer::BoxLayer(const Gl& gl) : gl_(&gl), faces_(gl, "side.frag"), lines_(gl) {}

void BoxLayer::draw_sides(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const ThemeColours& theme) const {
  const Program& program = faces_.use(projection, eye, depth_range(snapshot, eye));
  gl_->DepthMask(GL_FALSE);
  for (int side = 0; side < 6; ++side) {
    const std::optional<Wall>& wall = snapshot.walls[side];
    if (!wall || !faces_viewer(snapshot, side, eye)) continue;
    const Rectangle3 rectangle = side_of(snapshot, side);
    const Vec2 extent = rectangle.high - rectangle.low;
    // The rings move inwards as fast as the equivalent moving wall.
    const double period = std::max(1.0, 0.08 * extent.minCoeff());
    const double periods =
        wall->kind == WallKind::Driven ? 0.5 * wall->drive_speed * snapshot.time / period : 0.0;
    gl_->Uniform1i(program.uniform("u_pattern"), pattern_of(wall->kind));
    gl_->Uniform2f(program.uniform("u_extent"), extent.x(), extent.y());
    gl_->Uniform1f(program.uniform("u_advance"), std::floor(periods) - periods);
    set_colour(*gl_, program, "u_colour", wall_colour(*wall, snapshot.temperature, theme));
    faces_.draw(rectangle, eye, extent);
  }
  gl_->DepthMask(GL_TRUE);
}

void BoxLayer::draw_edges(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const ThemeColours& theme) {
  const double width =
      projection.samples *
      std::max(1.0, 0.0016 * std::min(projection.size.width, projection.size.height));
  // The edges of each side have its colour. Walls are drawn over periodic borders.
  for (const bool walls : {false, true}) {
    lines_.restart(eye, depth_range(snapshot, eye));
    for (int side = 0; side < 6; ++side) {
      const std::optional<Wall>& wall = snapshot.walls[side];
      if (wall.has_value() != walls) continue;
      const Rectangle3 rectangle = side_of(snapshot, side);
      const std::array<Vec2, 4> corners = {
          rectangle.low, Vec2(rectangle.high.x(), rectangle.low.y()), rectangle.high,
          Vec2(rectangle.low.x(), rectangle.high.y())};
      const Colour colour =
          wall ? wall_colour(*wall, snapshot.temperature, theme) : theme.static_wall;
      for (std::size_t k = 0; k < 4; ++k) {
        lines_.add(place_in(rectangle, corners[k]), place_in(rectangle, corners[(k + 1) % 4]),
                   width, colour);
      }
    }
    lines_.draw(projection.drawn(), walls ? 0.0 : 10.0 * width);
  }
}

SliceLayer::SliceLayer(const Gl& gl)
    : gl_(&gl), faces_(gl, "field.frag"), cells_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindTexture(GL_TEXTURE_2D, cells_.id());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void SliceLayer::draw(const Snapshot& snapshot, const std::vector<Slice>& slices,
                      const Projection& projection, const Eye& eye, const ColourScale& scale,
                      Colour gap) {
  const FieldMap& map = *snapshot.field;
  const Program& program = faces_.use(projection, eye, depth_range(snapshot, eye));
  const Size size = projection.size;
  gl_->Uniform1i(program.uniform("u_cells"), 0);
  set_colour(*gl_, program, "u_gap", gap);
  gl_->Uniform1f(
      program.uniform("u_period"),
      projection.samples * std::max(5.0, std::round(std::min(size.width, size.height) / 90.0)));
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, cells_.id());
  const std::vector<Slice> middle = {{Axis::Z, 0.5 * snapshot.box.z()}};
  for (const Slice& slice : slices.empty() ? middle : slices) {
    const auto axis = static_cast<int>(slice.axis);
    const auto [first, second] = others_of(axis);
    const double share = slice.position / snapshot.box[axis];
    const int layer = std::clamp(static_cast<int>(share * map.cells[axis]), 0, map.cells[axis] - 1);
    const std::array<std::size_t, 3> strides = {
        1, static_cast<std::size_t>(map.cells[0]),
        static_cast<std::size_t>(map.cells[0]) * static_cast<std::size_t>(map.cells[1])};
    colours_.clear();
    for (int j = 0; j < map.cells[second]; ++j) {
      for (int i = 0; i < map.cells[first]; ++i) {
        const double value =
            map.values[layer * strides[axis] + i * strides[first] + j * strides[second]];
        colours_.push_back(std::isnan(value) ? Colour{0, 0, 0, 0} : scale(value));
      }
    }
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, map.cells[first], map.cells[second], 0, GL_RGBA,
                    GL_UNSIGNED_BYTE, colours_.data());
    faces_.draw(
        {axis, slice.position, Vec2(0.0, 0.0), Vec2(snapshot.box[first], snapshot.box[second])},
        eye, Vec2(1.0, 1.0));
  }
}

}  // namespace clatter
