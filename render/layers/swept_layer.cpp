#include "render/layers/swept_layer.h"

#include <algorithm>
#include <cstddef>

#include "render/layers/chords.h"

namespace clatter {

SweptLayer::SweptLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "swept.vert", "swept.frag"),
      light_(gl),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.BindVertexArray(vertices_.id());
  const auto floats = [&](GLuint attribute, std::size_t offset) {
    gl.VertexAttribPointer(attribute, 2, GL_FLOAT, GL_FALSE, sizeof(Swept),
                           reinterpret_cast<const void*>(offset));
  };
  floats(0, offsetof(Swept, x));
  floats(1, offsetof(Swept, along_x));
  floats(2, offsetof(Swept, length));
  gl.VertexAttribPointer(3, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Swept),
                         reinterpret_cast<const void*>(offsetof(Swept, light)));
  for (GLuint attribute : {0, 1, 2, 3}) {
    gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribDivisor(attribute, 1);
  }
}

void SweptLayer::draw(const Snapshot& snapshot, const Projection& projection,
                      const DiskColours& colours) {
  // The shader divides by the way, so that disks which rest tremble too little to be seen.
  constexpr double kShortest = 1.0 / 32.0;  // pixels
  swept_.clear();
  for (const Chord& chord : chords(snapshot, projection, snapshot.exposure)) {
    const Vec2 way = chord.end - chord.start;
    const double length = std::max(way.norm(), kShortest);
    const Vec2 along = way.norm() > 0.0 ? Vec2(way.normalized()) : Vec2(1.0, 0.0);
    const Vec2 start = 0.5 * (chord.start + chord.end - length * along);
    swept_.push_back({static_cast<float>(start.x()), static_cast<float>(start.y()),
                      static_cast<float>(along.x()), static_cast<float>(along.y()),
                      static_cast<float>(length),
                      static_cast<float>((chord.to - chord.from) / snapshot.exposure),
                      light_of(colours.of(snapshot, chord.disk))});
  }
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, swept_.size() * sizeof(Swept), swept_.data(), GL_STREAM_DRAW);

  light_.begin(projection.drawn());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), projection.drawn().width, projection.drawn().height);
  gl_->Uniform1f(program_.uniform("u_radius"), 0.5 * snapshot.diameter * projection.scale());
  gl_->Uniform1f(program_.uniform("u_samples"), projection.samples);
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(swept_.size()));
  light_.end(projection, faces_of(snapshot), colours.blending);
}

}  // namespace clatter
