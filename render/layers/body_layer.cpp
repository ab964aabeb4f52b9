#include "render/layers/body_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/fixture_images.h"
#include "render/layers/disk_colours.h"
#include "render/layers/eye_uniforms.h"

namespace clatter {

namespace {

// A ball, with the layout of the attributes of sphere.vert.
struct Sphere {
  std::array<float, 4> centre;  // view coordinates, and the radius
  Light light;
};

constexpr double kEdge = 0.45;  // share of the colour of text in that of edges

// Width of lines, drawn pixels.
double line_width(const Projection& projection) {
  return projection.samples *
         std::max(1.5, 0.0026 * std::min(projection.size.width, projection.size.height));
}

// The colour of a face in the light of sphere.frag, by its normal in view coordinates.
Colour lit(Colour colour, const Vec3& normal, const Eye& eye) {
  const Vec3 key(-0.40, 0.62, 0.675), up = eye.axes().col(1);
  const double light = 0.45 + 0.15 * normal.dot(up) + 0.8 * std::max(normal.dot(key), 0.0);
  return {encoded_light(light * linear_light(colour.red)),
          encoded_light(light * linear_light(colour.green)),
          encoded_light(light * linear_light(colour.blue))};
}

// Lines across the holes of a partition that have valves.
std::vector<std::array<Vec2, 2>> valve_lines_of(const Partition& partition) {
  constexpr int kLines = 3;
  std::vector<std::array<Vec2, 2>> lines;
  for (const Hole& hole : partition.holes) {
    if (!hole.valve) continue;
    for (int k = 1; k <= kLines; ++k) {
      const double place = hole.from[1] + (hole.to[1] - hole.from[1]) * k / (kLines + 1);
      lines.push_back({Vec2(hole.from[0], place), Vec2(hole.to[0], place)});
    }
  }
  return lines;
}

// Whether a face of a box is turned to the viewer.
bool faces_viewer(const Vec3& place, const Vec3& normal, const Eye& eye) {
  if (eye.inverse_distance() == 0.0) return normal.dot(eye.axes().row(2)) > 0.0;
  return normal.dot(eye.viewer() - place) > 0.0;
}

Rectangle3 face_of(const Bodies::Block& block, int axis, bool high) {
  const auto [first, second] = others_of(axis);
  return {axis, (high ? block.high : block.low)[axis], Vec2(block.low[first], block.low[second]),
          Vec2(block.high[first], block.high[second])};
}

void add_outline(std::vector<Line>& lines, const Rectangle3& face, double width, Colour colour) {
  const std::array<Vec2, 4> corners = {face.low, Vec2(face.high.x(), face.low.y()), face.high,
                                       Vec2(face.low.x(), face.high.y())};
  for (std::size_t k = 0; k < 4; ++k) {
    lines.push_back(
        {place_in(face, corners[k]), place_in(face, corners[(k + 1) % 4]), width, colour});
  }
}

// A part of the plane of a partition in the drawn region; empty if it is outside.
Rectangle3 drawn_part(const Partition& partition, const DrawnRegion& region, const Vec2& low,
                      const Vec2& high) {
  const auto [first, second] = others_of(static_cast<int>(partition.axis));
  return {static_cast<int>(partition.axis), partition.position,
          low.cwiseMax(Vec2(region.low[first], region.low[second])),
          high.cwiseMin(Vec2(region.high[first], region.high[second]))};
}

bool is_drawn(const Partition& partition, const DrawnRegion& region) {
  const int axis = static_cast<int>(partition.axis);
  return partition.position > region.low[axis] && partition.position < region.high[axis];
}

// The edges of the closed part of a partition: along the sides of the box, and around its holes.
std::vector<std::array<Vec2, 2>> rims_of(const Partition& partition, const Snapshot& snapshot) {
  const auto others = others_of(static_cast<int>(partition.axis));
  std::vector<std::array<Vec2, 2>> rims;
  for (int k = 0; k < 2; ++k) {
    const int across = 1 - k;
    const auto add = [&](double from, double to, double place) {
      Vec2 a, b;
      a[k] = from;
      b[k] = to;
      a[across] = b[across] = place;
      rims.push_back({a, b});
    };
    const double length = snapshot.box[others[k]], width = snapshot.box[others[across]];
    for (const double side : {0.0, width}) {
      std::vector<std::array<double, 2>> openings;
      for (const Hole& hole : partition.holes) {
        const double end = side == 0.0 ? hole.from[across] : hole.to[across];
        if (end == side) openings.push_back({hole.from[k], hole.to[k]});
      }
      for (const auto& [from, to] : closed_parts({0.0, length}, openings)) add(from, to, side);
    }
    for (const Hole& hole : partition.holes) {
      for (const double place : {hole.from[across], hole.to[across]}) {
        if (place > 0.0 && place < width) add(hole.from[k], hole.to[k], place);
      }
    }
  }
  return rims;
}

}  // namespace

BodyLayer::BodyLayer(const Gl& gl, Blending blending)
    : gl_(&gl),
      blending_(blending),
      faces_(gl, "side.frag", "FILLED"),
      lines_(gl),
      balls_(gl, "sphere.vert", "sphere.frag",
             blending == Blending::Light ? "CUT BODY" : "CUT BODY ENCODED"),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(vertices_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Sphere), nullptr);
  gl.VertexAttribPointer(1, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Sphere),
                         reinterpret_cast<const void*>(offsetof(Sphere, light)));
  for (const GLuint attribute : {0, 1}) {
    gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribDivisor(attribute, 1);
  }
}

BodyLayer::Look BodyLayer::look_of(const FixtureLaw& law, const WallColours& colours) const {
  const Colour colour = colours.of(law.wall());
  return {mix(colours.theme.background, colour, 0.75), colour};
}

// `period` is that of the rings of a driven surface.
void BodyLayer::set_law(const Program& program, const FixtureLaw& law, const Snapshot& snapshot,
                        double period) const {
  const Wall wall = law.wall();
  gl_->Uniform1i(program.uniform("u_pattern"), static_cast<GLint>(side_pattern(wall.kind)));
  gl_->Uniform1f(program.uniform("u_advance"), -ring_advance(wall, snapshot.time, period));
}

void BodyLayer::draw_blocks(const Bodies& bodies, const Snapshot& snapshot,
                            const Projection& projection, const Eye& eye,
                            const WallColours& colours) const {
  const Program& program = faces_.use(snapshot.box, projection, eye);
  // Faces are behind their edges, whose lines reach over them.
  gl_->Enable(GL_POLYGON_OFFSET_FILL);
  gl_->PolygonOffset(static_cast<GLfloat>(line_width(projection)), 1.0f);
  for (const Bodies::Block& block : bodies.blocks) {
    const FixtureLaw& law = snapshot.obstacles[block.obstacle].law;
    const auto [fill, colour] = look_of(law, colours);
    set_colour(*gl_, program, "u_colour", mix(colour, colours.theme.text, kEdge));
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      const Vec3 normal = (side % 2 ? 1.0 : -1.0) * Vec3::Unit(axis);
      if (!faces_viewer(side % 2 ? block.high : block.low, normal, eye)) continue;
      const Rectangle3 face = face_of(block, axis, side % 2);
      const Vec2 extent = face.high - face.low;
      set_law(program, law, snapshot, std::max(1.0, 0.08 * extent.minCoeff()));
      set_colour(*gl_, program, "u_fill", lit(fill, eye.axes() * normal, eye));
      gl_->Uniform2f(program.uniform("u_extent"), extent.x(), extent.y());
      faces_.draw(face, eye, extent);
    }
  }
  gl_->Disable(GL_POLYGON_OFFSET_FILL);
}

void BodyLayer::draw_balls(const Bodies& bodies, const Snapshot& snapshot,
                           const Projection& projection, const Eye& eye, const WallColours& colours,
                           Part part) const {
  if (bodies.balls.empty()) return;
  balls_.use();
  set_eye(*gl_, balls_, snapshot.box, projection, eye);
  gl_->Uniform1f(balls_.uniform("u_samples"), projection.samples);
  gl_->Uniform1f(balls_.uniform("u_least"), part == Part::Inside ? 1.0f : 0.0f);
  set_vector(*gl_, balls_, "u_low", bodies.region.low);
  set_vector(*gl_, balls_, "u_high", bodies.region.high);
  // Nothing is drawn faintly.
  set_vector(*gl_, balls_, "u_ghost_low", bodies.region.high);
  set_vector(*gl_, balls_, "u_ghost_high", bodies.region.low);
  encode_light(*gl_, blending_ == Blending::Light);
  gl_->BindVertexArray(vertices_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  for (const Bodies::Ball& ball : bodies.balls) {
    const Vec3 centre = eye.seen(ball.centre);
    if (eye.w(centre + Vec3(0.0, 0.0, ball.radius)) < Eye::kNearest) continue;
    const FixtureLaw& law = snapshot.obstacles[ball.obstacle].law;
    set_law(balls_, law, snapshot, std::max(1.0, 0.16 * ball.radius));
    const Sphere sphere{{static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                         static_cast<float>(centre.z()), static_cast<float>(ball.radius)},
                        light_of(look_of(law, colours).fill)};
    gl_->BufferData(GL_ARRAY_BUFFER, sizeof sphere, &sphere, GL_STREAM_DRAW);
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 1);
  }
  encode_light(*gl_, false);
}

void BodyLayer::draw_edges(const Bodies& bodies, const Snapshot& snapshot,
                           const Projection& projection, const Eye& eye,
                           const WallColours& colours) {
  std::vector<Line> lines;
  for (const Bodies::Block& block : bodies.blocks) {
    const Colour colour = look_of(snapshot.obstacles[block.obstacle].law, colours).colour;
    const Colour edge = mix(colour, colours.theme.text, kEdge);
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool high : {false, true}) {
        const Vec3 normal = (high ? 1.0 : -1.0) * Vec3::Unit(axis);
        if (!faces_viewer(high ? block.high : block.low, normal, eye)) continue;
        add_outline(lines, face_of(block, axis, high), line_width(projection), edge);
      }
    }
  }
  lines_.draw(lines, snapshot.box, projection, eye);
}

void BodyLayer::draw_plate(const Partition& partition, const Bodies& bodies,
                           const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                           const WallColours& colours) const {
  const auto [first, second] = others_of(static_cast<int>(partition.axis));
  const Vec2 extent(snapshot.box[first], snapshot.box[second]);
  const bool membrane = !partition.passes.empty();
  const Program& program = faces_.use(snapshot.box, projection, eye);
  Colour fill = look_of(partition.law, colours).colour;
  fill.alpha = membrane ? 0x10 : 0x34;
  Colour pattern = fill;
  pattern.alpha = membrane ? 0x80 : 0xff;
  set_law(program, partition.law, snapshot, std::max(1.0, 0.08 * extent.minCoeff()));
  set_colour(*gl_, program, "u_colour", pattern);
  set_colour(*gl_, program, "u_fill", fill);
  gl_->Uniform2f(program.uniform("u_extent"), extent.x(), extent.y());
  gl_->DepthMask(GL_FALSE);
  for (const auto& [low, high] : closed_rectangles(partition, snapshot)) {
    const Rectangle3 part = drawn_part(partition, bodies.region, low, high);
    if ((part.low.array() < part.high.array()).all()) faces_.draw(part, eye, part.high, part.low);
  }
  gl_->DepthMask(GL_TRUE);
}

void BodyLayer::draw_rims(const Partition& partition, const Bodies& bodies,
                          const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const WallColours& colours) {
  const Colour colour = mix(look_of(partition.law, colours).colour, colours.theme.text, kEdge);
  const double width = line_width(projection), dash = 8.0 * width;
  const auto draw = [&](const std::vector<std::array<Vec2, 2>>& ends, double line, double dashed) {
    std::vector<Line> lines;
    for (const auto& [from, to] : ends) {
      const Rectangle3 part = drawn_part(partition, bodies.region, from, to);
      if ((part.low.array() > part.high.array()).any()) continue;
      lines.push_back({place_in(part, part.low), place_in(part, part.high), line, colour});
    }
    lines_.draw(lines, snapshot.box, projection, eye, dashed);
  };
  draw(rims_of(partition, snapshot), width, partition.passes.empty() ? 0.0 : dash);
  draw(valve_lines_of(partition), 0.5 * width, dash);
}

void BodyLayer::draw_partitions(const Bodies& bodies, const Snapshot& snapshot,
                                const Projection& projection, const Eye& eye,
                                const WallColours& colours) {
  std::vector<const Partition*> drawn;
  for (const Partition& partition : snapshot.partitions) {
    if (is_drawn(partition, bodies.region)) drawn.push_back(&partition);
  }
  // Parallel plates in the order from back to front.
  std::ranges::sort(drawn, {}, [&](const Partition* partition) {
    const int axis = static_cast<int>(partition->axis);
    return partition->position * eye.axes()(2, axis);
  });
  for (const Partition* partition : drawn) {
    draw_plate(*partition, bodies, snapshot, projection, eye, colours);
    draw_rims(*partition, bodies, snapshot, projection, eye, colours);
  }
}

}  // namespace clatter
