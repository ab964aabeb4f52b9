#pragma once

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "engine/picture/snapshot.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"
#include "render/output/image.h"
#include "render/palette.h"
#include "render/theme.h"

namespace clatter {

/// The pixel in column `x` from the left and row `y` from the top.
inline Colour pixel(const Image& image, int x, int y) {
  const unsigned char* p = &image.rgba[4 * (static_cast<std::size_t>(y) * image.size.width + x)];
  return {p[0], p[1], p[2], p[3]};
}

/// The largest difference of a channel between two colours.
inline int difference(Colour a, Colour b) {
  return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue),
                   std::abs(a.alpha - b.alpha)});
}

/// The largest difference of a channel between two pictures of one size.
inline int difference(const Image& a, const Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  }
  return largest;
}

/// A canvas cleared to a background, with the blending of Renderer.
inline Canvas blank_canvas(const Gl& gl, Size size, Colour background = kDarkTheme.background) {
  Canvas canvas(gl, size);
  gl.Viewport(0, 0, size.width, size.height);
  gl.ClearColor(background.red / 255.0f, background.green / 255.0f, background.blue / 255.0f,
                background.alpha / 255.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  return canvas;
}

/// A transparent background.
inline constexpr Colour kClear{0, 0, 0, 0};

/// A 20 x 25 box driven from left and right and periodic in y, with a lattice of moving disks and a
/// density field.
inline Snapshot driven_box() {
  Snapshot snapshot;
  snapshot.box = Vec2(20.0, 25.0);
  snapshot.time = 12.34;
  snapshot.temperature = 0.98;
  snapshot.collisions = 1234567;
  snapshot.walls[kLeft] = snapshot.walls[kRight] = Wall{WallKind::Driven, 1.0, 1.0, 1.0};
  constexpr int kDisks = 14 * 16;
  snapshot.positions.resize(2, kDisks);
  snapshot.velocities.resize(2, kDisks);
  for (int i = 0; i < kDisks; ++i) {
    snapshot.positions.col(i) = Vec2(1.0 + 1.35 * (i % 14), 0.3 + 1.55 * (i / 14));
    snapshot.velocities.col(i) = Vec2(0.01 * (i % 97), 0.02 * (i % 31));
  }
  FieldMap density{Quantity::Density, {4, 5}, {}};
  for (int i = 0; i < 20; ++i) density.values.push_back(0.05 * i);
  snapshot.field = density;
  return snapshot;
}

/// For tests of shapes: a picture with one pixel per world unit.
inline constexpr Size kUnitSize{200, 120};
inline const Projection kUnitProjection{{{100.0, 60.0}, 200.0}, kUnitSize};

/// One disk at rest in a walled box of the size of this picture.
inline Snapshot one_disk(Vec2 centre, double diameter) {
  Snapshot snapshot;
  snapshot.box = Vec2(kUnitSize.width, kUnitSize.height);
  snapshot.diameter = diameter;
  snapshot.walls.fill(Wall{});
  snapshot.positions = centre;
  snapshot.velocities = Vec2(0.0, 0.0);
  return snapshot;
}

/// A species of a legend.
inline Species species_of(const std::string& name, double diameter = 1.0,
                          std::optional<Rgb> colour = {}) {
  Species species;
  species.name = name;
  species.diameter = diameter;
  species.colour = colour;
  return species;
}

/// The texts of picture overlays.
inline const OverlayText kText{"Vibrated box",
                               "Watch the cold dense band form between the hot walls."};

/// The picture of a renderer.
inline Image draw(Renderer& renderer, const Gl& gl, const Snapshot& snapshot, const Camera& camera,
                  Size size, const View& view) {
  const Canvas canvas(gl, size);
  canvas.bind();
  renderer.draw(snapshot, camera, size, view, kText);
  return canvas.read();
}

/// A view with the density field.
inline View view_with_field() {
  View view;
  view.field = Quantity::Density;
  return view;
}

}  // namespace clatter
