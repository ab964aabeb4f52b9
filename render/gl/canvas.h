#pragma once

#include <optional>

#include "render/gl/gl_object.h"
#include "render/gl/shader_program.h"
#include "render/output/image.h"

namespace clatter {

/// Whether a canvas has a depth for each pixel.
enum class Depth { None, Buffer };

/// An off-screen render target: RGBA, by default with 8 bits per channel and sRGB colours.
///
/// In OpenGL ES, draw calls blend stored sRGB values or linear light according to the format of the
/// framebuffer. So a canvas with sRGB colours has a second picture there, for blending in linear
/// light, and LightCopy copies between the two.
class Canvas {
 public:
  /// Creates a picture of `size` pixels. Throws RunError if OpenGL does not support the size.
  Canvas(const Gl& gl, Size size, GLint format = GL_SRGB8_ALPHA8, Depth depth = Depth::None);

  /// The largest side of a picture that OpenGL supports, in pixels.
  static int largest_side(const Gl& gl);

  /// Size in pixels.
  Size size() const { return size_; }
  /// Format of the colours, as given.
  GLint format() const { return format_; }
  /// Whether it has depths.
  Depth depth() const { return depth_ ? Depth::Buffer : Depth::None; }
  /// Makes this canvas the target of later draw calls.
  void bind() const;
  /// As bind(), but without depths, so that shaders can read them from depth_texture().
  void bind_colours() const;
  /// Reads the current picture.
  Image read() const;
  /// Copies the picture into another framebuffer, 0 for the window of the context, with its lower
  /// left corner at pixel (x, y). The framebuffer becomes the target of later draw calls.
  void copy_to(GLuint framebuffer, int x = 0, int y = 0) const;
  /// Whether later bind() calls choose the picture for blending in linear light.
  bool in_light() const { return in_light_; }
  /// OpenGL ES: chooses the picture of later bind() calls.
  void choose_light(bool on);
  /// OpenGL ES: name of the texture of the picture for blending in linear light; 0: none.
  GLuint light_texture() const { return light_ ? light_->colour.id() : 0; }
  /// OpenGL name of the texture that holds the picture.
  GLuint texture() const { return stored_.colour.id(); }
  /// OpenGL name of the texture that holds the depths. Only with Depth::Buffer.
  GLuint depth_texture() const { return depth_->id(); }

 private:
  // A picture and its framebuffers.
  struct Target {
    Target(const Gl& gl, Size size, GLint format, const std::optional<Texture>& depth);
    Texture colour;
    Framebuffer framebuffer;
    std::optional<Framebuffer> colours;  // without the depths; absent: there are none
  };
  const Target& target() const { return in_light_ ? *light_ : stored_; }

  const Gl* gl_;
  Size size_;
  GLint format_;
  std::optional<Texture> depth_;
  Target stored_;
  std::optional<Target>
      light_;  ///< OpenGL ES: for blending in linear light; absent: not chosen yet
  bool in_light_ = false;
};

/// OpenGL ES: copies a canvas between its stored sRGB values and its picture for blending in linear
/// light, see Canvas. Each copy has the bits of the other.
class LightCopy {
 public:
  explicit LightCopy(const Gl& gl);

  /// Makes later draw calls blend in linear light or in stored values. The canvas must be bound.
  void blend_in_light(Canvas& canvas, bool on) const;

 private:
  const Gl* gl_;
  Program program_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
};

}  // namespace clatter
