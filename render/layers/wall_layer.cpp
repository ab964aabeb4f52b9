#include "render/layers/wall_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "render/theme.h"

namespace clatter {

namespace {

// As in wall.frag: the patterns, and the teeth's period in thicknesses of the band.
enum Pattern { kHatch, kTeeth, kGlow, kDashes };
constexpr double kToothPeriod = 0.75;

struct Look {
  Pattern pattern;
  Colour colour;
  double advance = 0.0;  // of a driven wall's teeth, world units
};

// A thermal wall's colour compares it with the gas: 0.5 of the way up where they are as hot.
Colour thermal_colour(double wall_temperature, double gas_temperature) {
  const double sum = wall_temperature + gas_temperature;
  const ColourScale heat{colour_map(Palette::Inferno), -0.5, 1.0};
  return heat(sum > 0.0 ? wall_temperature / sum : 0.5);
}

Look look_of(const std::optional<Wall>& wall, const Snapshot& snapshot) {
  if (!wall) return {kDashes, theme::kStaticWall};
  switch (wall->kind) {
    case WallKind::Static:
      return {kHatch, theme::kStaticWall};
    case WallKind::Driven:
      // A wall that comes at speed V adds 2 V to what it hits.
      return {kTeeth, theme::kDrivenWall, 0.5 * wall->drive_speed * snapshot.time};
    case WallKind::Sawtooth:
    case WallKind::Sinusoidal:
      return {kTeeth, theme::kDrivenWall};
    case WallKind::Thermal:
      return {kGlow, thermal_colour(wall->temperature, snapshot.temperature)};
  }
  return {kHatch, theme::kStaticWall};
}

struct Vertex {
  float x, y;            // pixels
  float along, outward;  // pixels from the wall's lower or left end, and from its face
};

// The band's four corners as a triangle strip; where walls meet, it is mitred.
std::array<Vertex, 4> band(Side side, const Snapshot& snapshot, const Projection& projection,
                           double inner, double outer) {
  const int axis = side / 2, other = 1 - axis;
  const bool far = side % 2;
  const bool meets_walls = snapshot.walls[2 * other].has_value();
  const Vec2 low = projection.pixels({0.0, 0.0});
  const Vec2 high = projection.pixels(snapshot.box);

  std::array<Vertex, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const bool at_end = i % 2;
    const double outward = i / 2 ? outer : inner;
    const double overhang = meets_walls ? outward : 0.0;
    Vec2 place;
    place[axis] = far ? high[axis] + outward : low[axis] - outward;
    place[other] = at_end ? high[other] + overhang : low[other] - overhang;
    corners[i] = {static_cast<float>(place.x()), static_cast<float>(place.y()),
                  static_cast<float>(place[other] - low[other]), static_cast<float>(outward)};
  }
  return corners;
}

double line_width(Size size) {
  return std::max(1.0, std::round(wall_thickness(size) / 10.0));
}

}  // namespace

double wall_thickness(Size size) {
  return std::max(6.0, std::round(0.025 * std::min(size.width, size.height)));
}

WallLayer::WallLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "wall.vert", "wall.frag"),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(vertices_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                         reinterpret_cast<const void*>(offsetof(Vertex, along)));
  gl.EnableVertexAttribArray(0);
  gl.EnableVertexAttribArray(1);
}

void WallLayer::draw(const Snapshot& snapshot, const Projection& projection) const {
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), projection.size.width, projection.size.height);
  gl_->Uniform1f(program_.uniform("u_thickness"), wall_thickness(projection.size));
  gl_->Uniform1f(program_.uniform("u_line"), line_width(projection.size));
  gl_->BindVertexArray(vertices_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  for (Side side : {kLeft, kRight, kBottom, kTop}) draw_side(side, snapshot, projection);
}

void WallLayer::draw_side(Side side, const Snapshot& snapshot, const Projection& projection) const {
  const Look look = look_of(snapshot.walls[side], snapshot);
  const double thickness = wall_thickness(projection.size);
  const double line = line_width(projection.size);
  const bool is_line = look.pattern == kDashes;
  const auto corners = band(side, snapshot, projection, is_line ? -0.5 * line : 0.0,
                            is_line ? 0.5 * line : thickness);
  gl_->BufferData(GL_ARRAY_BUFFER, sizeof corners, corners.data(), GL_STREAM_DRAW);

  const double periods = look.advance * projection.scale() / (kToothPeriod * thickness);
  gl_->Uniform1i(program_.uniform("u_pattern"), look.pattern);
  gl_->Uniform1f(program_.uniform("u_advance"), periods - std::floor(periods));
  gl_->Uniform4f(program_.uniform("u_colour"), look.colour.red / 255.0f, look.colour.green / 255.0f,
                 look.colour.blue / 255.0f, look.colour.alpha / 255.0f);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace clatter
