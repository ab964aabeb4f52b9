#include "render/layers/trail_layer.h"

#include <algorithm>

#include "render/layers/chords.h"

namespace clatter {

TrailLayer::TrailLayer(const Gl& gl)
    : gl_(&gl), program_(gl, "trail.vert", "trail.frag"), light_(gl), strokes_(gl) {}

// GL_MAX blending: overlapping lines show the stronger one, so joints are invisible.
void TrailLayer::draw(const Snapshot& snapshot, const std::vector<FlightPiece>& flights,
                      const Projection& projection, const DiskColours& colours, double time,
                      const Tiling& tiling) {
  constexpr double kOpacity = 0.6;  // at the disk
  drawn_.clear();
  for (const Chord& chord : chords(snapshot, flights, projection, time, tiling)) {
    const Vec2 opacities = {kOpacity * (1.0 + chord.from / time),
                            kOpacity * (1.0 + chord.to / time)};
    drawn_.push_back({{chord.start.cast<float>(), chord.end.cast<float>(), opacities.cast<float>()},
                      light_of(colours.of(snapshot, chord.disk))});
  }

  const Size size = projection.drawn();
  const double radius = 0.5 * snapshot.diameter * projection.scale();
  light_.begin(size, GL_MAX);
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  gl_->Uniform1f(program_.uniform("u_half"), std::max(0.2 * radius, 0.6 * projection.samples));
  strokes_.draw(drawn_);
  light_.end(projection, faces_of(snapshot), tiling.faintness, colours.blending);
}

}  // namespace clatter
