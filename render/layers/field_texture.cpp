#include "render/layers/field_texture.h"

#include <algorithm>
#include <cmath>

namespace clatter {

FieldTexture::FieldTexture(const Gl& gl)
    : gl_(&gl), cells_(generate<Texture>(gl, gl.GenTextures)) {}

static Colour premultiplied(Colour colour, double opacity) {
  return opacity == 1.0 ? colour : mix({0, 0, 0, 0}, colour, opacity);
}

void FieldTexture::bind(const PlaneMap& map, const ColourScale& scale, FieldStyle style) {
  const bool smooth = style == FieldStyle::Smooth;
  colours_.clear();
  if (smooth) {
    const SmoothMap drawn = smoothed(map);
    for (std::size_t i = 0; i < drawn.values.size(); ++i) {
      const double share = drawn.shares[i];
      colours_.push_back(share > 0.0 ? premultiplied(scale(drawn.values[i]), share)
                                     : Colour{0, 0, 0, 0});
    }
  } else {
    for (const double value : map.values) {
      colours_.push_back(std::isnan(value) ? Colour{0, 0, 0, 0} : scale(value));
    }
  }
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, cells_.id());
  const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  const auto wrap = [&](int axis) { return map.periodic[axis] ? GL_REPEAT : GL_CLAMP_TO_EDGE; };
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap(0));
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap(1));
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, map.width, map.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  colours_.data());
  // Opaque colours need no blending, which takes much of the time on a processor.
  const bool opaque = std::ranges::all_of(colours_, [](Colour c) { return c.alpha == 255; });
  if (opaque) gl_->Disable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void FieldTexture::unbind() const {
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace clatter
