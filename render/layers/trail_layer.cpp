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
  const bool alike = snapshot.grains.empty();
  const auto half_of = [&](std::size_t disk) {
    const double radius = snapshot.radius(disk) * projection.scale();
    return static_cast<float>(std::max(0.2 * radius, 0.6 * projection.samples));
  };
  drawn_.clear();
  halves_.clear();
  for (const Chord& chord : chords(snapshot, flights, projection, time, tiling)) {
    const Vec2 opacities = {kOpacity * (1.0 + chord.from / time),
                            kOpacity * (1.0 + chord.to / time)};
    drawn_.push_back({{chord.start.cast<float>(), chord.end.cast<float>(), opacities.cast<float>()},
                      light_of(colours.of(snapshot, chord.disk))});
    if (!alike) halves_.push_back(half_of(chord.disk));
  }
  if (alike) halves_ = {half_of(0)};

  const Size size = projection.drawn();
  light_.begin(size, GL_MAX);
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  strokes_.draw(drawn_, halves_);
  light_.end(projection, faces_of(snapshot), tiling.faintness, colours.blending);
}

}  // namespace clatter
