#pragma once

#include <optional>

#include "render/gl/canvas.h"
#include "render/gl/shader_program.h"
#include "render/layers/wall_layer.h"

namespace clatter {

/// How disks go over what lies below them.
enum class Blending {
  Light,   ///< as light, into a framebuffer of sRGB: their edges look right on any background
  Encoded  ///< by colours as stored, like all else: for pictures without a background
};

/// Lays light over a picture: what covers each of its pixels only in part, and how brightly.
class LightLayer {
 public:
  explicit LightLayer(const Gl& gl);

  /// From now on an empty picture of `size` collects what is drawn: light times opacity, and the
  /// opacity. The two add up, or with GL_MAX as `equation` the greatest counts.
  void begin(Size size, GLenum equation = GL_FUNC_ADD);
  /// Lays what it has collected over what was bound before.
  void end(const Projection& projection, const Faces& faces, Blending blending);
  /// Lays a texture over what is bound; it has `margin` more pixels on every side. Of what lies
  /// outside the faces only a ghost is seen.
  void draw(GLuint light, int margin, const Projection& projection, const Faces& faces,
            Blending blending) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;             ///< without attributes: the shader knows the corners
  std::optional<Canvas> collected_;  ///< absent: not used yet
  GLint target_ = 0;                 ///< the framebuffer that was bound before
};

}  // namespace clatter
