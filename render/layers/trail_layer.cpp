#include "render/layers/trail_layer.h"

#include <algorithm>
#include <cstddef>

#include "render/layers/chords.h"

namespace clatter {

TrailLayer::TrailLayer(const Gl& gl)
    : gl_(&gl),
      program_(gl, "trail.vert", "trail.frag"),
      light_(gl),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.BindVertexArray(vertices_.id());
  const auto floats = [&](GLuint attribute, std::size_t offset) {
    gl.VertexAttribPointer(attribute, 2, GL_FLOAT, GL_FALSE, sizeof(Line),
                           reinterpret_cast<const void*>(offset));
  };
  floats(0, offsetof(Line, x0));
  floats(1, offsetof(Line, x1));
  floats(2, offsetof(Line, opacity0));
  gl.VertexAttribPointer(3, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Line),
                         reinterpret_cast<const void*>(offsetof(Line, light)));
  for (GLuint attribute : {0, 1, 2, 3}) {
    gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribDivisor(attribute, 1);
  }
}

// Where lines meet or cross the stronger is seen, so that joints do not show.
void TrailLayer::draw(const Snapshot& snapshot, const Projection& projection,
                      const DiskColours& colours, double time) {
  constexpr double kOpacity = 0.6;  // where the disk is
  lines_.clear();
  for (const Chord& chord : chords(snapshot, projection, time)) {
    const auto opacity = [&](double at) {
      return static_cast<float>(kOpacity * (1.0 + at / time));
    };
    lines_.push_back({static_cast<float>(chord.start.x()), static_cast<float>(chord.start.y()),
                      static_cast<float>(chord.end.x()), static_cast<float>(chord.end.y()),
                      opacity(chord.from), opacity(chord.to),
                      light_of(colours.of(snapshot, chord.disk))});
  }
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, lines_.size() * sizeof(Line), lines_.data(), GL_STREAM_DRAW);

  const Size size = projection.drawn();
  const double radius = 0.5 * snapshot.diameter * projection.scale();
  light_.begin(size, GL_MAX);
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  gl_->Uniform1f(program_.uniform("u_half"), std::max(0.2 * radius, 0.6 * projection.samples));
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(lines_.size()));
  light_.end(projection, faces_of(snapshot), colours.blending);
}

}  // namespace clatter
