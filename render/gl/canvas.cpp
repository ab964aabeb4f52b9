#include "render/gl/canvas.h"

#include <algorithm>
#include <string>

#include "engine/error.h"

namespace clatter {

// A texture of depths; none without depth.
static std::optional<Texture> depths_of(const Gl& gl, Size size, Depth depth) {
  if (depth == Depth::None) return std::nullopt;
  Texture depths = generate<Texture>(gl, gl.GenTextures);
  gl.BindTexture(GL_TEXTURE_2D, depths.id());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size.width, size.height, 0,
                GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return depths;
}

static Size checked(const Gl& gl, Size size) {
  const int largest = Canvas::largest_side(gl);
  if (std::max(size.width, size.height) <= largest) return size;
  throw RunError("a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                 " pixels is too large: at most " + std::to_string(largest) + " a side");
}

// ES encodes whatever is drawn into an sRGB format.
static GLint stored_format(const Gl& gl, GLint format) {
  return gl.api == Api::Es && format == GL_SRGB8_ALPHA8 ? GL_RGBA8 : format;
}

Canvas::Target::Target(const Gl& gl, Size size, GLint format, const std::optional<Texture>& depth)
    : colour(generate<Texture>(gl, gl.GenTextures)),
      framebuffer(generate<Framebuffer>(gl, gl.GenFramebuffers)) {
  const bool is_float = format == GL_RGBA16F || format == GL_RGBA32F;
  gl.BindTexture(GL_TEXTURE_2D, colour.id());
  gl.TexImage2D(GL_TEXTURE_2D, 0, format, size.width, size.height, 0, GL_RGBA,
                is_float ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  const auto attach = [&](GLenum point, const Texture& texture) {
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture.id(), 0);
  };
  if (depth) {
    colours = generate<Framebuffer>(gl, gl.GenFramebuffers);
    gl.BindFramebuffer(GL_FRAMEBUFFER, colours->id());
    attach(GL_COLOR_ATTACHMENT0, colour);
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  attach(GL_COLOR_ATTACHMENT0, colour);
  if (depth) attach(GL_DEPTH_ATTACHMENT, *depth);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw RunError("this OpenGL cannot draw off screen");
  }
}

Canvas::Canvas(const Gl& gl, Size size, GLint format, Depth depth)
    : gl_(&gl),
      size_(checked(gl, size)),
      format_(format),
      depth_(depths_of(gl, size, depth)),
      stored_(gl, size, stored_format(gl, format), depth_) {}

void Canvas::choose_light(bool on) {
  if (on && !light_) light_.emplace(*gl_, size_, GL_SRGB8_ALPHA8, depth_);
  in_light_ = on;
}

int Canvas::largest_side(const Gl& gl) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  return largest;
}

void Canvas::bind() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, target().framebuffer.id());
}

void Canvas::bind_colours() const {
  const Target& here = target();
  gl_->BindFramebuffer(GL_FRAMEBUFFER, (here.colours ? *here.colours : here.framebuffer).id());
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
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, target().framebuffer.id());
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  gl_->BlitFramebuffer(0, 0, size_.width, size_.height, x, y, x + size_.width, y + size_.height,
                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

LightCopy::LightCopy(const Gl& gl)
    : gl_(&gl),
      program_(gl, "field.vert", "light_copy.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {}

void LightCopy::blend_in_light(Canvas& canvas, bool on) const {
  const Size size = canvas.size();
  canvas.choose_light(on);
  canvas.bind_colours();
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->Disable(GL_BLEND);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, on ? canvas.texture() : canvas.light_texture());
  program_.use();
  gl_->Uniform2f(program_.uniform("u_size"), size.width, size.height);
  gl_->Uniform2f(program_.uniform("u_low"), 0.0f, 0.0f);
  gl_->Uniform2f(program_.uniform("u_high"), size.width, size.height);
  gl_->Uniform1i(program_.uniform("u_picture"), 0);
  gl_->Uniform1i(program_.uniform("u_to_light"), on);
  gl_->BindVertexArray(vertices_.id());
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_->Enable(GL_BLEND);
  canvas.bind();
}

}  // namespace clatter
