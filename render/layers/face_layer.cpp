#include "render/layers/face_layer.h"

#include "render/layers/eye_uniforms.h"

namespace clatter {

std::array<int, 2> others_of(int axis) {
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

Vec3 place_in(const Rectangle3& rectangle, const Vec2& place) {
  const auto [first, second] = others_of(rectangle.axis);
  Vec3 position;
  position[rectangle.axis] = rectangle.position;
  position[first] = place.x();
  position[second] = place.y();
  return position;
}

FaceLayer::FaceLayer(const Gl& gl, const char* fragment_file, const char* defines)
    : gl_(&gl),
      program_(gl, "face.vert", fragment_file, defines),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(vertices_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 5 * sizeof(float), nullptr);
  gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, 5 * sizeof(float),
                         reinterpret_cast<const void*>(3 * sizeof(float)));
  gl.EnableVertexAttribArray(0);
  gl.EnableVertexAttribArray(1);
}

const Program& FaceLayer::use(const Vec3& box, const Projection& projection, const Eye& eye) const {
  program_.use();
  set_eye(*gl_, program_, box, projection, eye);
  return program_;
}

void FaceLayer::draw(const Rectangle3& rectangle, const Eye& eye, const Vec2& place,
                     const Vec2& start) const {
  std::array<float, 20> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 share(k % 2, k / 2);
    const Vec2 at = rectangle.low + share.cwiseProduct(rectangle.high - rectangle.low);
    const Vec3 seen = eye.seen(place_in(rectangle, at));
    for (int i = 0; i < 3; ++i) corners[5 * k + i] = static_cast<float>(seen[i]);
    const Vec2 shown = start + share.cwiseProduct(place - start);
    for (int i = 0; i < 2; ++i) corners[5 * k + 3 + i] = static_cast<float>(shown[i]);
  }
  gl_->BindVertexArray(vertices_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, sizeof corners, corners.data(), GL_STREAM_DRAW);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace clatter
