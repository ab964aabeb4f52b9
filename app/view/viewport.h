#pragma once

#include <imgui.h>

#include <optional>

#include "app/view/session.h"
#include "app/view/window_map.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"

namespace clatter {

/// The picture of the gas in the window, drawn as in films, and its mouse actions.
class Viewport {
 public:
  explicit Viewport(const Gl& gl) : gl_(&gl), renderer_(gl) {}

  /// Draws a frame off screen at `size` pixels if anything has changed. `letters` scales the text
  /// relative to films, and `least` is its smallest size in pixels. With `heading` the picture has
  /// title and caption.
  void draw(const Frame& frame, const View& view, Size size, double letters, double least,
            bool heading);
  /// Copies the picture to the window. (x, y) is its lower left corner in pixels of the window.
  void show(int x, int y) const;
  /// Size of the picture, pixels. Requires drawn().
  Size size() const { return canvas_->size(); }
  /// The current picture. Requires drawn().
  Image picture() const { return canvas_->read(); }

  /// The mapping between the world and the window, if the viewport has its upper left corner at
  /// `corner` and `scale` pixels per window unit. Requires drawn().
  WindowMap map(ImVec2 corner, float scale) const {
    return {camera_, canvas_->size(), corner, scale};
  }
  /// Pans, zooms, turns spheres and picks particles with the mouse. `over`: the mouse is over the
  /// viewport. `presses`: presses of the left button are for the viewport. Returns true if the
  /// angles of the view changed.
  bool use_mouse(const Frame& frame, View& view, const WindowMap& map, bool over, bool presses);
  /// Marks the picked particle and the pair of the last collision step.
  void mark(ImDrawList& list, const Frame& frame, const WindowMap& map) const;

  /// Shows the whole box again.
  void fit();
  /// The picked particle; absent: none.
  const std::optional<std::size_t>& picked() const { return picked_; }
  /// Position of the picked particle in the window; absent: not there.
  std::optional<ImVec2> picked_place(const Frame& frame, const WindowMap& map) const;
  /// True if the camera follows the picked particle.
  bool follows() const { return follows_; }
  /// Deselects the picked particle. Returns true if there was one.
  bool let_go();
  /// True after the first picture.
  bool drawn() const { return canvas_.has_value(); }
  /// Draws the pictures. It may also draw other pictures of the window.
  Renderer& renderer() { return renderer_; }
  /// Makes the next call of draw() redraw the picture.
  void redraw() { stale_ = true; }

 private:
  // A press of the left button on the viewport.
  struct Press {
    ImVec2 place;
    std::optional<std::size_t> particle = {};
    bool twice = false;    // the second press of a double click
    bool dragged = false;  // the mouse has moved since
  };

  void zoom(const Frame& frame, const WindowMap& map);
  void pan(const WindowMap& map);
  bool drag_or_click(const Frame& frame, View& view, const WindowMap& map, bool over);
  void aim(const Vec3& centre);

  const Gl* gl_;
  Renderer renderer_;
  AutoRanges ranges_;
  std::optional<Canvas> canvas_;
  Camera camera_;
  bool fits_ = true;
  bool stale_ = true;
  std::uint64_t run_ = 0;
  std::optional<Press> press_;  // while the button is down
  std::optional<std::size_t> picked_;
  bool follows_ = false;
};

}  // namespace clatter
