#include "render/layers/disk_layer.h"

#include <array>
#include <cstddef>

#include "render/layers/wall_layer.h"

namespace clatter {

namespace {

double radius_pixels(const Snapshot& snapshot, const Projection& projection) {
  return 0.5 * snapshot.diameter * projection.scale();
}

// A disk's soft edge reaches half a pixel beyond its radius, and no disk is drawn below one pixel.
double reach_pixels(const Snapshot& snapshot, const Projection& projection) {
  return std::max(radius_pixels(snapshot, projection), 0.5) + 0.5;
}

double largest_point_of(const Gl& gl) {
  std::array<GLfloat, 2> range = {};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, range.data());
  return range[1];
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

DiskLayer::DiskLayer(const Gl& gl, std::optional<double> largest_point)
    : gl_(&gl),
      largest_point_(largest_point.value_or(largest_point_of(gl))),
      point_(gl, "disk_point.vert", "disk.frag"),
      square_(gl, "disk_quad.vert", "disk.frag"),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      points_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      squares_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  for (const auto& [array, divisor] : {std::pair(points_.id(), 0), std::pair(squares_.id(), 1)}) {
    gl.BindVertexArray(array);
    gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Disk), nullptr);
    gl.VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Disk),
                           reinterpret_cast<const void*>(offsetof(Disk, colour)));
    for (GLuint attribute : {0, 1}) {
      gl.EnableVertexAttribArray(attribute);
      gl.VertexAttribDivisor(attribute, divisor);
    }
  }
}

void DiskLayer::draw(const Snapshot& snapshot, const Projection& projection, ColourBy colour_by,
                     const ColourScale& scale, Colour plain) {
  collect(snapshot, projection, colour_by, scale, plain);
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

void DiskLayer::collect(const Snapshot& snapshot, const Projection& projection, ColourBy colour_by,
                        const ColourScale& scale, Colour plain) {
  const double reach = reach_pixels(snapshot, projection);
  const double radius = 0.5 * snapshot.diameter;
  const Vec2 high(projection.drawn().width + reach, projection.drawn().height + reach);

  // The shifts along an axis that bring a disk, or its image across a periodic border, into sight.
  auto shifts = [&](int axis, double place, auto&& visit) {
    visit(0.0);
    if (snapshot.walls[2 * axis]) return;
    if (place < radius) visit(snapshot.box[axis]);
    if (place > snapshot.box[axis] - radius) visit(-snapshot.box[axis]);
  };

  disks_.clear();
  for (std::size_t i = 0; i < snapshot.positions.size(); ++i) {
    const Vec2& place = snapshot.positions[i];
    const Colour colour =
        colour_by == ColourBy::None ? plain : scale(disk_value(snapshot, colour_by, i));
    shifts(0, place.x(), [&](double dx) {
      shifts(1, place.y(), [&](double dy) {
        const Vec2 centre = projection.pixels(place + Vec2(dx, dy));
        if ((centre.array() <= -reach).any() || (centre.array() >= high.array()).any()) return;
        disks_.push_back({static_cast<float>(centre.x()), static_cast<float>(centre.y()), colour});
      });
    });
  }
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
