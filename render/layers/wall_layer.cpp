#include "render/layers/wall_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace clatter {

namespace {

// Must match wall.frag: the patterns, and the period of teeth over the thickness of the band.
enum Pattern { kHatch, kTeeth, kWaves, kGlow, kDashes, kPlain };
constexpr double kToothPeriod = 0.75;
// A multiple of the periods of all patterns along the wall, over the thickness of the band.
constexpr double kCommonPeriod = 6.0;

struct Look {
  Pattern pattern;
  Colour colour;
  double advance = 0.0;  // displacement of a driven wall's teeth, world units
};

// Displacement of the pattern of a wall along the other axis, world units.
double slide_of(const std::optional<Wall>& wall, int other, const Snapshot& snapshot) {
  return wall ? wall->surface_velocity[static_cast<std::size_t>(other)] * snapshot.time : 0.0;
}

Look look_of(const std::optional<Wall>& wall, const Snapshot& snapshot,
             const WallColours& colours) {
  if (!wall) return {kDashes, colours.theme.static_wall};
  const Colour colour = colours.of(*wall);
  switch (wall->kind) {
    case WallKind::Static:
      return {kHatch, colour};
    case WallKind::Driven:
      // A wall moving at speed V adds 2 V to the normal velocity of a disk.
      return {kTeeth, colour, 0.5 * wall->drive_speed * snapshot.time};
    case WallKind::Sawtooth:
      return {kTeeth, colour};
    case WallKind::Sinusoidal:
      return {kWaves, colour};
    case WallKind::Thermal:
      return {kGlow, colour};
  }
  return {kHatch, colour};
}

// Thickness in drawn pixels, a whole number of pixels of the finished picture.
double thickness_of(const Projection& projection) {
  return projection.samples * wall_thickness(projection.size);
}

// The four corners, as a triangle strip, of a band along the face of a wall. It reaches from
// `inner` to `outer` pixels outside the face. Mitred ends join the bands of adjacent walls. The
// pattern is fixed to the box or to the wall's surface, so it does not move with the adjacent wall.
enum class Ends { Straight, Mitred };
std::array<WallLayer::Vertex, 4> band(Side side, const Snapshot& snapshot,
                                      const Projection& projection, double inner, double outer,
                                      Ends ends) {
  const int axis = side / 2, other = 1 - axis;
  const bool far = side % 2;
  const bool mitred = ends == Ends::Mitred && snapshot.walls[2 * other];
  const Faces faces = faces_of(snapshot);
  const Vec2 low = projection.pixels(faces.low), high = projection.pixels(faces.high);
  // Whole numbers of periods of all patterns are left out, because the numbers are floats.
  const double slide = slide_of(snapshot.walls[side], other, snapshot) * projection.scale();
  const double periods = kCommonPeriod * thickness_of(projection);
  const double origin = projection.pixels({0.0, 0.0})[other] + std::fmod(slide, periods);

  std::array<WallLayer::Vertex, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const bool at_end = i % 2;
    const double outward = i / 2 ? outer : inner;
    const double overhang = mitred ? outward : 0.0;
    Vec2 place;
    place[axis] = far ? high[axis] + outward : low[axis] - outward;
    place[other] = at_end ? high[other] + overhang : low[other] - overhang;
    corners[i] = {static_cast<float>(place.x()), static_cast<float>(place.y()),
                  static_cast<float>(place[other] - origin), static_cast<float>(outward)};
  }
  return corners;
}

double line_width(const Projection& projection) {
  return projection.samples * std::max(1.0, std::round(wall_thickness(projection.size) / 10.0));
}

}  // namespace

double wall_thickness(Size size) {
  return std::max(6.0, std::round(0.025 * std::min(size.width, size.height)));
}

Faces faces_of(const Snapshot& snapshot) {
  const auto& moved = snapshot.wall_displacement;
  return {Vec2(moved[kLeft], moved[kBottom]), snapshot.box - Vec2(moved[kRight], moved[kTop])};
}

Faces outermost_faces(const Snapshot& snapshot) {
  const auto travel = [&](Side side) {
    const auto& wall = snapshot.walls[side];
    return wall ? wall->outermost_travel() : 0.0;
  };
  return {-Vec2(travel(kLeft), travel(kBottom)), snapshot.box + Vec2(travel(kRight), travel(kTop))};
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

void WallLayer::draw(const Snapshot& snapshot, const Projection& projection,
                     const WallColours& colours) const {
  program_.use();
  const Size drawn = projection.drawn();
  gl_->Uniform2f(program_.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform1f(program_.uniform("u_thickness"), thickness_of(projection));
  gl_->Uniform1f(program_.uniform("u_line"), line_width(projection));
  gl_->BindVertexArray(vertices_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  for (Side side : {kLeft, kRight, kBottom, kTop}) {
    const auto& wall = snapshot.walls[side];
    if (wall && (wall->moves() || snapshot.wall_displacement[side] > 0.0))
      draw_place(side, snapshot, projection, colours);
  }
  for (Side side : {kLeft, kRight, kBottom, kTop}) draw_side(side, snapshot, projection, colours);
}

void WallLayer::draw_place(Side side, const Snapshot& snapshot, const Projection& projection,
                           const WallColours& colours) const {
  const double line = line_width(projection);
  // Hides the heatmap behind the face, where there is no gas.
  const double moved_in = snapshot.wall_displacement[side] * projection.scale();
  if (moved_in > 0.0) {
    draw_band(band(side, snapshot, projection, 0.0, moved_in, Ends::Straight), kPlain,
              colours.theme.background);
  }
  Colour place = colours.theme.static_wall;
  place.alpha = 0x60;
  draw_band(band(side, snapshot, projection, moved_in, moved_in + line, Ends::Straight), kPlain,
            place);
}

void WallLayer::draw_side(Side side, const Snapshot& snapshot, const Projection& projection,
                          const WallColours& colours) const {
  const Look look = look_of(snapshot.walls[side], snapshot, colours);
  const double thickness = thickness_of(projection);
  const double line = line_width(projection);
  const bool is_line = look.pattern == kDashes;
  const double periods = look.advance * projection.scale() / (kToothPeriod * thickness);
  gl_->Uniform1f(program_.uniform("u_advance"), periods - std::floor(periods));
  gl_->Uniform1i(program_.uniform("u_slides"),
                 snapshot.walls[side] && snapshot.walls[side]->slides());
  draw_band(band(side, snapshot, projection, is_line ? -0.5 * line : 0.0,
                 is_line ? 0.5 * line : thickness, Ends::Mitred),
            look.pattern, look.colour);
}

void WallLayer::draw_band(const std::array<Vertex, 4>& corners, int pattern, Colour colour) const {
  gl_->BufferData(GL_ARRAY_BUFFER, sizeof corners, corners.data(), GL_STREAM_DRAW);
  gl_->Uniform1i(program_.uniform("u_pattern"), pattern);
  set_colour(*gl_, program_, "u_colour", colour);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace clatter
