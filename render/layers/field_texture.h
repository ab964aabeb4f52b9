#pragma once

#include <vector>

#include "render/gl/gl_object.h"
#include "render/palette.h"
#include "render/plane_map.h"

namespace clatter {

/// The colours of a plane field as a texture for field.frag: in texture unit 0, multiplied by their
/// opacity, which is the share of cells with a value.
class FieldTexture {
 public:
  explicit FieldTexture(const Gl& gl);

  /// Binds the colours of a map in this style, and the blending for them. To be followed by
  /// unbind() after drawing.
  void bind(const PlaneMap& map, const ColourScale& scale, FieldStyle style);
  /// Restores the usual blending of layers.
  void unbind() const;

 private:
  const Gl* gl_;
  Texture cells_;
  std::vector<Colour> colours_;  ///< [height][width]; reused to avoid allocations
};

}  // namespace clatter
