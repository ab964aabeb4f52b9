#pragma once

#include <string>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/layers/legend.h"
#include "render/theme.h"
#include "render/typography/gui_context.h"
#include "render/typography/gui_layer.h"

namespace clatter {

/// Heading of the picture and options of its text.
struct OverlayText {
  std::string title;     ///< empty: none
  std::string caption;   ///< empty: none
  double card = 0.0;     ///< opacity of a title card over the whole picture, 0..1
  double letters = 1.0;  ///< scale of all text
  double least = 0.0;    ///< smallest size of the text, pixels
  double speed = 1.0;    ///< simulation time per second, of captions that fade
  /// Titles of the pictures beside this one. The headings of all of them have one height.
  std::vector<std::string> others = {};
};

/// Opacity of a title card `time` seconds after the beginning of a film. The card lasts `length`
/// seconds and fades out in the last half second.
double card_opacity(double length, double time);

/// Opacity of a caption at a simulation time. It fades in and out for half a second of a film with
/// `speed` time units per second, or for a third of its time if that is shorter.
double caption_opacity(const Caption& caption, double time, double speed);

/// Draws text and scales in the margins of the picture: title, time, temperature, collisions,
/// captions, colour bars and a scale bar, without the parts that the view hides.
class Overlay {
 public:
  explicit Overlay(const Gl& gl);

  /// The margins that the overlay needs in a picture of `size` with the whole box.
  Margins margins(const Snapshot& snapshot, Size size, const View& view, const Legends& legends,
                  const OverlayText& text);

  /// Draws the overlay over a picture of `snapshot`.
  void draw(const Snapshot& snapshot, const Projection& projection, const View& view,
            const Legends& legends, const OverlayText& text);

 private:
  /// Loads the fonts for a picture of `size` and for its title. The context must be current.
  const Fonts& fonts_for(Size size, const OverlayText& text);

  GuiLayer gui_;
  GuiContext context_;
  Fonts fonts_;               ///< of the last picture
  std::string loaded_title_;  ///< title in the card font
};

}  // namespace clatter
