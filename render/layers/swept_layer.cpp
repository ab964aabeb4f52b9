#include "render/layers/swept_layer.h"

#include <algorithm>

#include "render/layers/chords.h"

namespace clatter {

SweptLayer::SweptLayer(const Gl& gl)
    : gl_(&gl), program_(gl, "swept.vert", "swept.frag"), light_(gl), strokes_(gl) {}

void SweptLayer::draw(const Snapshot& snapshot, const Projection& projection,
                      const DiskColours& colours, const Tiling& tiling, double least) {
  // The shader divides by the length of the way, so a disk at rest gets an invisibly short way.
  constexpr double kShortest = 1.0 / 32.0;  // pixels
  drawn_.clear();
  radii_.clear();
  const bool alike = snapshot.grains.empty();
  for (const Chord& chord :
       chords(snapshot, snapshot.flights, projection, snapshot.exposure, tiling)) {
    const double radius = snapshot.radius(chord.disk) * projection.scale();
    if (radius < least) continue;
    if (!alike) radii_.push_back(static_cast<float>(radius));
    const Vec2 way = chord.end - chord.start;
    const double length = std::max(way.norm(), kShortest);
    const Vec2 along = way.norm() > 0.0 ? Vec2(way.normalized()) : Vec2(1.0, 0.0);
    const Vec2 start = 0.5 * (chord.start + chord.end - length * along);
    const double share = (chord.to - chord.from) / snapshot.exposure;
    drawn_.push_back({{start.cast<float>(), along.cast<float>(), Vec2(length, share).cast<float>()},
                      light_of(colours.of(snapshot, chord.disk))});
  }

  light_.begin(projection.drawn());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), projection.drawn().width, projection.drawn().height);
  gl_->Uniform1f(program_.uniform("u_samples"), projection.samples);
  if (alike) radii_ = {static_cast<float>(snapshot.radius(0) * projection.scale())};
  strokes_.draw(drawn_, radii_);
  light_.end(projection, faces_of(snapshot), tiling.faintness, colours.blending);
}

}  // namespace clatter
