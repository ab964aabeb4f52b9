#pragma once

#include <string>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/layers/gui_context.h"
#include "render/layers/gui_layer.h"
#include "render/layers/legend.h"
#include "render/theme.h"

namespace clatter {

/// What the app wants said above the picture; empty: nothing.
struct OverlayText {
  std::string title;
  std::string caption;
  double card = 0.0;     ///< opacity of a card with the two over the whole picture, 0..1
  double letters = 1.0;  ///< how many times as large as usual all letters are
};

/// The opacity of a card that stands for the first `length` seconds of a film, `time` seconds after
/// its beginning: 1, and fading out in the last third.
double card_opacity(double length, double time);

/// Writes on the picture: title, time, temperature, collisions, colour bars and a scale bar, in the
/// margins that it asks for.
class Overlay {
 public:
  explicit Overlay(const Gl& gl);

  /// The space its texts take along the edges of a picture of `size` that shows the whole box.
  Margins margins(const Snapshot& snapshot, Size size, const Legends& legends,
                  const OverlayText& text);

  /// Draws it over a picture of `snapshot`.
  void draw(const Snapshot& snapshot, const Projection& projection, const Legends& legends,
            const OverlayText& text, const ThemeColours& theme);

 private:
  /// Loads the fonts for a picture of `size`, and for a title; the context must be current.
  Fonts fonts_for(Size size, const OverlayText& text);

  GuiLayer gui_;
  GuiContext context_;
  float loaded_size_ = 0.0f;  ///< of the text of the loaded fonts, pixels; 0: none yet
  std::string loaded_title_;  ///< whose letters are loaded for cards
};

}  // namespace clatter
