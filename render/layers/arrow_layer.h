#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"
#include "render/gl/shader_program.h"
#include "render/palette.h"

namespace clatter {

/// Shape of an arrow, in pixels.
struct ArrowShape {
  double shaft = 1.0;        ///< half width of the shaft
  double head_length = 1.0;  ///< length of the head
  double head_width = 1.0;   ///< half width of the head

  /// The shape in a picture of `size`, in drawn pixels, with `samples` drawn pixels per finished
  /// pixel along each axis. Arrows shorter than 1.5 heads are scaled down.
  static ArrowShape in(Size size, int samples = 1);
};

/// Draws a vector field as arrows. The middle of an arrow is at the position of its value.
class ArrowLayer {
 public:
  explicit ArrowLayer(const Gl& gl);

  /// Draws `map` with arrows of `pixels` drawn pixels per unit of value, at most two cells long.
  void draw(const ArrowMap& map, const Projection& projection, double pixels, Colour colour,
            Colour rim);

 private:
  struct Arrow {
    float tail_x, tail_y, tip_x, tip_y;  ///< drawn pixels
  };

  void collect(const ArrowMap& map, const Projection& projection, double pixels);

  const Gl* gl_;
  Program program_;
  Buffer buffer_;
  VertexArray vertices_;       ///< reads the buffer, one instance per arrow
  std::vector<Arrow> arrows_;  ///< reused to avoid allocations
};

}  // namespace clatter
