#include "render/layers/disk_layer.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "render/layers/wall_layer.h"

namespace clatter {

namespace {

double radius_pixels(const Snapshot& snapshot, const Projection& projection) {
  return 0.5 * snapshot.diameter * projection.scale();
}

// A disk's soft edge reaches half a pixel beyond its radius.
double reach_pixels(const Snapshot& snapshot, const Projection& projection) {
  return radius_pixels(snapshot, projection) + 0.5;
}

double largest_point_of(const Gl& gl) {
  std::array<GLfloat, 2> range = {};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, range.data());
  return range[1];
}

// Calls `visit` with centre, in pixels, and colour of each disk in sight, and of its images across
// a periodic border.
template <class Visit>
void visit_disks(const Snapshot& snapshot, const Projection& projection, const DiskColours& colours,
                 Visit visit) {
  const double reach = reach_pixels(snapshot, projection);
  const double radius = 0.5 * snapshot.diameter;
  const Vec2 high(projection.drawn().width + reach, projection.drawn().height + reach);

  // The shifts along an axis that bring a disk, or its image, into sight.
  auto shifts = [&](int axis, double place, auto&& shifted) {
    shifted(0.0);
    if (snapshot.walls[2 * axis]) return;
    if (place < radius) shifted(snapshot.box[axis]);
    if (place > snapshot.box[axis] - radius) shifted(-snapshot.box[axis]);
  };

  for (std::size_t i = 0; i < snapshot.positions.size(); ++i) {
    const Vec2& place = snapshot.positions[i];
    const Colour colour = colours.of(snapshot, i);
    shifts(0, place.x(), [&](double dx) {
      shifts(1, place.y(), [&](double dy) {
        const Vec2 centre = projection.pixels(place + Vec2(dx, dy));
        if ((centre.array() <= -reach).any() || (centre.array() >= high.array()).any()) return;
        visit(centre, colour);
      });
    });
  }
}

std::uint16_t of_65535(float share) {
  return static_cast<std::uint16_t>(std::lround(65535.0f * share));
}

}  // namespace

double disk_value(const Snapshot& snapshot, ColourBy colour_by, std::size_t i) {
  switch (colour_by) {
    case ColourBy::None:
      return 0.0;
    case ColourBy::Speed:
      return snapshot.velocities[i].norm();
    case ColourBy::VelocityX:
      return snapshot.velocities[i].x();
    case ColourBy::VelocityY:
      return snapshot.velocities[i].y();
    case ColourBy::Spin:
      return snapshot.spins.empty() ? 0.0 : snapshot.spins[i];
  }
  return 0.0;
}

Colour DiskColours::of(const Snapshot& snapshot, std::size_t i) const {
  return colour_by == ColourBy::None ? plain : scale(disk_value(snapshot, colour_by, i));
}

DiskLayer::DiskLayer(const Gl& gl, std::optional<double> largest_point)
    : gl_(&gl),
      largest_point_(largest_point.value_or(largest_point_of(gl))),
      point_(gl, "disk_point.vert", "disk.frag"),
      square_(gl, "disk_quad.vert", "disk.frag"),
      coverage_layer_(gl),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      points_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      squares_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  for (const auto& [array, divisor] : {std::pair(points_.id(), 0), std::pair(squares_.id(), 1)}) {
    gl.BindVertexArray(array);
    gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Disk), nullptr);
    gl.VertexAttribPointer(1, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Disk),
                           reinterpret_cast<const void*>(offsetof(Disk, light)));
    for (GLuint attribute : {0, 1}) {
      gl.EnableVertexAttribArray(attribute);
      gl.VertexAttribDivisor(attribute, divisor);
    }
  }
}

void DiskLayer::draw(const Snapshot& snapshot, const Projection& projection,
                     const DiskColours& colours) {
  // Edges and small disks let what lies below through as light, whatever their size.
  gl_->Enable(GL_FRAMEBUFFER_SRGB);
  if (radius_pixels(snapshot, projection) < Coverage::kLargestRadius) {
    draw_coverage(snapshot, projection, colours);
  } else {
    draw_shapes(snapshot, projection, colours);
  }
  gl_->Disable(GL_FRAMEBUFFER_SRGB);
}

void DiskLayer::draw_coverage(const Snapshot& snapshot, const Projection& projection,
                              const DiskColours& colours) {
  coverage_.restart(projection.drawn(), radius_pixels(snapshot, projection));
  visit_disks(snapshot, projection, colours,
              [&](const Vec2& centre, Colour colour) { coverage_.add(centre, colour); });
  coverage_.sum();
  const Faces faces = faces_of(snapshot);
  coverage_layer_.draw(coverage_, projection.pixels(faces.low), projection.pixels(faces.high));
}

void DiskLayer::draw_shapes(const Snapshot& snapshot, const Projection& projection,
                            const DiskColours& colours) {
  disks_.clear();
  visit_disks(snapshot, projection, colours, [&](const Vec2& centre, Colour colour) {
    disks_.push_back({static_cast<float>(centre.x()),
                      static_cast<float>(centre.y()),
                      {of_65535(linear_light(colour.red)), of_65535(linear_light(colour.green)),
                       of_65535(linear_light(colour.blue)), of_65535(colour.alpha / 255.0f)}});
  });
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, disks_.size() * sizeof(Disk), disks_.data(), GL_STREAM_DRAW);

  const GLsizei count = static_cast<GLsizei>(disks_.size());
  if (2.0 * reach_pixels(snapshot, projection) <= largest_point_) {
    set_uniforms(point_, snapshot, projection);
    gl_->Enable(GL_PROGRAM_POINT_SIZE);
    gl_->BindVertexArray(points_.id());
    gl_->DrawArrays(GL_POINTS, 0, count);
  } else {
    set_uniforms(square_, snapshot, projection);
    gl_->BindVertexArray(squares_.id());
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
  }
  gl_->Viewport(0, 0, projection.drawn().width, projection.drawn().height);
}

void DiskLayer::set_uniforms(const Program& program, const Snapshot& snapshot,
                             const Projection& projection) const {
  const int margin = static_cast<int>(reach_pixels(snapshot, projection)) + 1;
  const int width = projection.drawn().width + 2 * margin;
  const int height = projection.drawn().height + 2 * margin;
  gl_->Viewport(-margin, -margin, width, height);

  const Faces faces = faces_of(snapshot);
  const Vec2 low = projection.pixels(faces.low);
  const Vec2 high = projection.pixels(faces.high);
  program.use();
  gl_->Uniform2f(program.uniform("u_origin"), -margin, -margin);
  gl_->Uniform2f(program.uniform("u_extent"), width, height);
  gl_->Uniform1f(program.uniform("u_reach"), reach_pixels(snapshot, projection));
  gl_->Uniform1f(program.uniform("u_radius"), radius_pixels(snapshot, projection));
  gl_->Uniform1f(program.uniform("u_samples"), projection.samples);
  gl_->Uniform2f(program.uniform("u_box_low"), low.x(), low.y());
  gl_->Uniform2f(program.uniform("u_box_high"), high.x(), high.y());
}

}  // namespace clatter
