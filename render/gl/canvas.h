#pragma once

#include <optional>

#include "render/gl/gl_object.h"
#include "render/output/image.h"

namespace clatter {

/// Whether a canvas has a depth for each pixel.
enum class Depth { None, Buffer };

/// An off-screen render target: RGBA, by default with 8 bits per channel and sRGB colours.
class Canvas {
 public:
  /// Creates a picture of `size` pixels. Throws RunError if OpenGL does not support the size.
  Canvas(const Gl& gl, Size size, GLint format = GL_SRGB8_ALPHA8, Depth depth = Depth::None);

  /// The largest side of a picture that OpenGL supports, in pixels.
  static int largest_side(const Gl& gl);

  /// Size in pixels.
  Size size() const { return size_; }
  /// Whether it has depths.
  Depth depth() const { return depth_ ? Depth::Buffer : Depth::None; }
  /// Makes this canvas the target of later draw calls.
  void bind() const;
  /// As bind(), but without depths, so that shaders can read them from depth_texture(). Only with
  /// Depth::Buffer.
  void bind_colours() const;
  /// Reads the current picture.
  Image read() const;
  /// Copies the picture into another framebuffer, 0 for the window of the context, with its lower
  /// left corner at pixel (x, y). The framebuffer becomes the target of later draw calls.
  void copy_to(GLuint framebuffer, int x = 0, int y = 0) const;
  /// OpenGL name of the texture that holds the picture.
  GLuint texture() const { return colour_.id(); }
  /// OpenGL name of the texture that holds the depths. Only with Depth::Buffer.
  GLuint depth_texture() const { return depth_->id(); }

 private:
  const Gl* gl_;
  Size size_;
  Texture colour_;
  std::optional<Texture> depth_;
  Framebuffer framebuffer_;
  std::optional<Framebuffer> colours_;  ///< without the depths
};

}  // namespace clatter
