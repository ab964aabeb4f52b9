#pragma once

#include <imgui.h>

#include <optional>

#include "app/view/session.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"

namespace clatter {

/// Where the gas is drawn, as films draw it, and what a person does there with the mouse.
class Viewport {
 public:
  explicit Viewport(const Gl& gl) : gl_(&gl), renderer_(gl) {}

  /// Draws a frame into a picture of its own, of `size` pixels, with letters so many times as large
  /// as in films, if anything has changed.
  void draw(const Frame& frame, const View& view, Size size, double letters);
  /// Copies the picture into the window, its lower left corner at a pixel of it.
  void show(int x, int y) const;
  /// The picture as it is.
  Image picture() const { return canvas_->read(); }

  /// Pans, zooms, picks a disk, where the mouse is over the viewport, whose upper left corner is at
  /// `corner` in units of the window, each `scale` pixels.
  void use_mouse(const Frame& frame, ImVec2 corner, float scale);
  /// Marks the picked disk and a pair that has just collided.
  void mark(ImDrawList& list, const Frame& frame, ImVec2 corner, float scale) const;

  /// The place in the box that is at a place of the window, and the reverse; once it has drawn.
  Vec2 world(ImVec2 mouse, ImVec2 corner, float scale) const;
  ImVec2 place(const Vec2& world, ImVec2 corner, float scale) const;  ///< likewise

  /// Shows the whole box again.
  void fit();
  /// The disk that was clicked; absent: none.
  const std::optional<std::size_t>& picked() const { return picked_; }
  /// Where it is in the window.
  std::optional<ImVec2> picked_place(const Frame& frame, ImVec2 corner, float scale) const;
  /// Whether the camera follows it.
  bool follows() const { return follows_; }
  /// Lets go of the picked disk; whether there was one.
  bool let_go();
  /// Whether it has drawn.
  bool drawn() const { return canvas_.has_value(); }
  /// Draws the next frame anew.
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
