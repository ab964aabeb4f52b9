#pragma once

#include <optional>

#include "render/gl/canvas.h"
#include "render/gl/shader_program.h"
#include "render/layers/coverage.h"
#include "render/layers/wall_layer.h"

// Light. Particles are blended in linear light, and several samples per pixel are averaged in it.
// So a picture has the same colours as a finer picture seen from far away. A picture of faded
// particles is the mean of one with them and one without. Particles below 1.5 pixels in radius have
// no shape: Coverage sums their light and area in each pixel. Those of spheres are composed from
// front to back.

namespace clatter {

/// Blending of disks with the picture below.
enum class Blending {
  Light,   ///< in linear light, into an sRGB framebuffer: correct edges on any background
  Encoded  ///< in stored sRGB values, like other layers: for pictures without a background
};

/// Blends light with partial coverage over a picture.
class LightLayer {
 public:
  explicit LightLayer(const Gl& gl);

  /// Redirects later draw calls to an empty buffer of `size`. It collects light times opacity, and
  /// opacity. `equation` combines overlapping values: GL_FUNC_ADD or GL_MAX.
  void begin(Size size, GLenum equation = GL_FUNC_ADD);
  /// Blends the buffer over the framebuffer that was bound before begin(). Light outside the faces
  /// has the opacity `faintness`.
  void end(const Projection& projection, const Faces& faces, float faintness, Blending blending);
  /// Blends the light of a coverage over the bound framebuffer, with faces as above.
  void draw(const Coverage& coverage, const Projection& projection, const Faces& faces,
            float faintness, Blending blending);

 private:
  // Blends a texture over the bound framebuffer. The texture has `margin` more pixels on every
  // side.
  void draw(GLuint light, int margin, const Projection& projection, const Faces& faces,
            float faintness, Blending blending);

  const Gl* gl_;
  ProgramVariants programs_;
  VertexArray vertices_;             ///< no attributes: the shader computes the corners
  Texture areas_;                    ///< of a coverage
  std::optional<Canvas> collected_;  ///< buffer of begin(); absent: not used yet
  GLint target_ = 0;                 ///< framebuffer bound before begin()
};

}  // namespace clatter
