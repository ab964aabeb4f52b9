#pragma once

#include "render/gl/gl_object.h"
#include "render/output/image.h"

namespace clatter {

/// An off-screen picture that OpenGL draws into: RGBA, by default 8 bits each, colours in sRGB.
class Canvas {
 public:
  /// Throws RunError where the picture is larger than this OpenGL allows.
  Canvas(const Gl& gl, Size size, GLint format = GL_SRGB8_ALPHA8);

  /// The extent asked for.
  Size size() const { return size_; }
  /// Sends what is drawn from now on into this canvas.
  void bind() const;
  /// The picture as drawn so far.
  Image read() const;
  /// Copies the picture into the window that the context is of, with its lower left corner at a
  /// pixel of it, and sends what is drawn from now on into that window.
  void show(int x, int y) const;
  /// The name of the texture that it is.
  GLuint texture() const { return colour_.id(); }

 private:
  const Gl* gl_;
  Size size_;
  Texture colour_;
  Framebuffer framebuffer_;
};

}  // namespace clatter
