#pragma once

#include "render/gl/canvas.h"
#include "render/layers/renderer.h"
#include "render/output/image.h"

namespace clatter {

/// Draws a gas into its cell of the pictures of a film.
class FilmCell {
 public:
  /// A cell of `size` with the heading `text`. The other arguments are as for Renderer.
  FilmCell(const Gl& gl, Size size, int samples, bool transparent, const View& view,
           OverlayText text);

  const View& view() const { return view_; }
  /// Sets the ends of the automatic colour ranges.
  void fix(const RangeEnds& ends) { ranges_.fix(ends); }
  /// The camera that shows the whole box.
  Camera fit(const Snapshot& snapshot) {
    return renderer_.fit(snapshot, canvas_.size(), view_, text_, ranges_.legends(snapshot, view_));
  }
  /// Sets the simulation time per second of film, for captions that fade.
  void set_speed(double speed) { text_.speed = speed; }
  /// Sets the title card to its state `seconds` after the start of the film.
  void show_card(double seconds);
  /// The picture of a snapshot. `whole` is the result of fit(). Throws Interrupted.
  Image draw(const Snapshot& snapshot, const Camera& whole);

 private:
  View view_;
  OverlayText text_;
  Canvas canvas_;
  Renderer renderer_;
  AutoRanges ranges_;
};

}  // namespace clatter
