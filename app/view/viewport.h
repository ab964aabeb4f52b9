#pragma once

#include <imgui.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/view/messages.h"
#include "app/view/session.h"
#include "app/view/window_map.h"
#include "engine/scene/view.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"

namespace clatter {

/// A direction of view for spheres, with its button and its key.
struct Preset {
  char key;  ///< lower-case letter of the key
  const char* label;
  const char* help;
  double azimuth, elevation;
};

/// Along each axis, and from a corner of the box.
inline constexpr std::array<Preset, 4> kPresets = {
    {{'x', "x", "From the right, along x (X)", 90.0, 0.0},
     {'y', "y", "From above, along y (Y)", 0.0, 90.0},
     {'z', "z", "From the front, along z (Z)", 0.0, 0.0},
     {'i', "iso", "Isometric: from a corner, with equal lengths along all axes (I)", 45.0,
      35.26438968275465}}};

/// Sets the angles of a view to a preset. Returns true if they changed.
bool face(View& view, const Preset& preset);

/// Turns a view of spheres by a drag of the mouse, in window units: the front follows the mouse.
/// Azimuths stay within -180..180 and elevations within -90..90. Returns true if the angles
/// changed.
bool turn(View& view, float right, float down);

/// The picture of the gas in the window, drawn as in films, and its mouse actions. Gases that are
/// compared have cells beside each other. Their colour ranges are the same. Those with equal boxes
/// are also seen by the same camera. The mouse acts on the selected gas.
class Viewport {
 public:
  explicit Viewport(const Gl& gl) : gl_(&gl), renderer_(gl) {}

  /// Draws a frame off screen at `size` pixels if anything has changed. `letters` scales the text
  /// relative to films, and `least` is its smallest size in pixels. With `heading` the picture has
  /// title and caption. `titles` are the headings of the cells of compared gases; empty: one gas.
  void draw(const Frame& frame, const View& view, Size size, double letters, double least,
            bool heading, const std::vector<std::string>& titles);
  /// Copies the picture to the window. (x, y) is its lower left corner in pixels of the window.
  void show(int x, int y) const;
  /// Size of the picture, pixels. Requires drawn().
  Size size() const { return size_; }
  /// The current picture. Requires drawn().
  Image picture() const;

  /// The mapping between the world of the selected gas and the window, if the viewport has its
  /// upper left corner at `corner` and `scale` pixels per window unit. Requires drawn().
  WindowMap map(ImVec2 corner, float scale) const;
  /// Number of cells in the current picture. Requires drawn().
  std::size_t cells() const { return pictures_.size(); }
  /// The place in the window of the cell of a gas, or of the selected one. `corner` and `scale` are
  /// as for map(). Requires drawn().
  Area cell(ImVec2 corner, float scale, std::size_t gas) const;
  Area cell(ImVec2 corner, float scale) const { return cell(corner, scale, gas_); }  ///< the same
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
  bool drawn() const { return !pictures_.empty(); }
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

  // The cell of a gas.
  struct Picture {
    Canvas canvas;
    Camera camera = {};
    VecX box = {};  // of the gas when it was drawn last
  };

  void resize(Size size, std::size_t gases);
  void draw_gas(Picture& picture, const Frame& frame, const View& view, const OverlayText& text,
                const Legends& legends);
  Camera& camera() { return pictures_[gas_].camera; }
  void zoom(const Frame& frame, const WindowMap& map);
  void pan(const WindowMap& map);
  bool drag_or_click(const Frame& frame, View& view, const WindowMap& map, bool over);
  void aim(const Vec3& centre);

  const Gl* gl_;
  Renderer renderer_;
  std::array<AutoRanges, 2> ranges_;  // of disks and of spheres
  Size size_;
  std::vector<Picture> pictures_;  // of the gases in order; empty: nothing is drawn
  std::size_t gas_ = 0;            // the selected one
  bool fits_ = true;
  bool stale_ = true;
  std::uint64_t run_ = 0;
  std::optional<Press> press_;  // while the button is down
  std::optional<std::size_t> picked_;
  bool follows_ = false;
};

}  // namespace clatter
