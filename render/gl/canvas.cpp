#include "render/gl/canvas.h"

#include <algorithm>
#include <string>

#include "engine/error.h"

namespace clatter {

Canvas::Canvas(const Gl& gl, Size size, GLint format, Depth depth)
    : gl_(&gl),
      size_(size),
      colour_(generate<Texture>(gl, gl.GenTextures)),
      framebuffer_(generate<Framebuffer>(gl, gl.GenFramebuffers)) {
  const int largest = largest_side(gl);
  if (std::max(size.width, size.height) > largest) {
    throw RunError("a picture of " + std::to_string(size.width) + "x" +
                   std::to_string(size.height) + " pixels is too large: at most " +
                   std::to_string(largest) + " a side");
  }
  gl.BindTexture(GL_TEXTURE_2D, colour_.id());
  gl.TexImage2D(GL_TEXTURE_2D, 0, format, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  const auto attach_colours = [&] {
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
  };
  if (depth == Depth::Buffer) {
    colours_ = generate<Framebuffer>(gl, gl.GenFramebuffers);
    bind_colours();
    attach_colours();
  }
  bind();
  attach_colours();
  if (depth == Depth::Buffer) {
    depth_ = generate<Texture>(gl, gl.GenTextures);
    gl.BindTexture(GL_TEXTURE_2D, depth_->id());
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size.width, size.height, 0,
                  GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_->id(), 0);
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw RunError("this OpenGL cannot draw off screen");
  }
}

int Canvas::largest_side(const Gl& gl) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  return largest;
}

void Canvas::bind() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
}

void Canvas::bind_colours() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, colours_->id());
}

Image Canvas::read() const {
  const std::size_t row = 4 * static_cast<std::size_t>(size_.width);
  Image image{size_, std::vector<unsigned char>(row * size_.height)};
  bind();
  gl_->PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl_->ReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());

  // The first row of OpenGL is the lowest one.
  auto top = image.rgba.begin();
  auto bottom = image.rgba.end() - row;
  for (; top < bottom; top += row, bottom -= row) std::swap_ranges(top, top + row, bottom);
  return image;
}

void Canvas::copy_to(GLuint framebuffer, int x, int y) const {
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  gl_->BlitFramebuffer(0, 0, size_.width, size_.height, x, y, x + size_.width, y + size_.height,
                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

}  // namespace clatter
