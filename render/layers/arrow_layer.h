#pragma once

#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/palette.h"

namespace clatter {

/// The form of an arrow, in pixels.
struct ArrowShape {
  double shaft = 1.0;        ///< half width of the shaft
  double head_length = 1.0;  ///< of the head, along the arrow
  double head_width = 1.0;   ///< half width of the head

  /// That of arrows in a picture of `size`, in pixels drawn, of which each of the picture's has
  /// `samples` along an axis; shorter ones than 1.5 heads shrink as a whole.
  static ArrowShape in(Size size, int samples = 1);
};

/// Draws a vector field as arrows, the middle of each at the place of its value.
class ArrowLayer {
 public:
  explicit ArrowLayer(const Gl& gl);

  /// Draws `map` with arrows of `pixels` per unit of value, but none longer than two cells.
  void draw(const ArrowMap& map, const Projection& projection, double pixels, Colour colour,
            Colour rim);

 private:
  struct Arrow {
    float tail_x, tail_y, tip_x, tip_y;  ///< pixels
  };

  void collect(const ArrowMap& map, const Projection& projection, double pixels);

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;       ///< the buffer, an arrow an instance
  std::vector<Arrow> arrows_;  ///< kept to save its memory
};

}  // namespace clatter
