#pragma once

#include <imgui.h>

#include <optional>

#include "app/view/session.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"

namespace clatter {

/// The picture of the gas in the window, drawn as in films, and its mouse actions. Arguments
/// `corner` are the upper left corner of the viewport in window units. Arguments `scale` are the
/// pixels per window unit.
class Viewport {
 public:
  explicit Viewport(const Gl& gl) : gl_(&gl), renderer_(gl) {}

  /// Draws a frame off screen at `size` pixels if anything has changed. `letters` scales the text
  /// relative to films.
  void draw(const Frame& frame, const View& view, Size size, double letters);
  /// Copies the picture to the window. (x, y) is its lower left corner in pixels of the window.
  void show(int x, int y) const;
  /// The current picture. Requires drawn().
  Image picture() const { return canvas_->read(); }

  /// Pans, zooms and picks disks with the mouse. Call it only if the mouse is over the viewport.
  void use_mouse(const Frame& frame, ImVec2 corner, float scale);
  /// Marks the picked disk and the pair of the last collision step.
  void mark(ImDrawList& list, const Frame& frame, ImVec2 corner, float scale) const;

  /// World position at a position of the window. Requires drawn().
  Vec2 world(ImVec2 mouse, ImVec2 corner, float scale) const;
  /// Position in the window of a world position. Requires drawn().
  ImVec2 place(const Vec2& world, ImVec2 corner, float scale) const;

  /// Shows the whole box again.
  void fit();
  /// The picked disk; absent: none.
  const std::optional<std::size_t>& picked() const { return picked_; }
  /// Position of the picked disk in the window; absent: no such disk.
  std::optional<ImVec2> picked_place(const Frame& frame, ImVec2 corner, float scale) const;
  /// True if the camera follows the picked disk.
  bool follows() const { return follows_; }
  /// Deselects the picked disk. Returns true if there was one.
  bool let_go();
  /// True after the first picture.
  bool drawn() const { return canvas_.has_value(); }
  /// Makes the next call of draw() redraw the picture.
  void redraw() { stale_ = true; }

 private:
  std::optional<std::size_t> disk_at(const Frame& frame, const Vec2& point) const;

  const Gl* gl_;
  Renderer renderer_;
  std::optional<Canvas> canvas_;
  Camera camera_;
  bool fits_ = true;
  bool stale_ = true;
  std::uint64_t run_ = 0;
  std::optional<std::size_t> picked_;
  bool follows_ = false;
};

}  // namespace clatter
