#include "render/layers/volume_layer.h"

#include <cmath>

#include "render/drawn_region.h"
#include "render/layers/eye_uniforms.h"

namespace clatter {

// The light of a cell. The last channel is its share of the largest extinction coefficient.
static Eigen::Array4f fog_of(double value, const ColourScale& scale) {
  if (std::isnan(value)) return Eigen::Array4f::Zero();
  const Light light = light_of(scale(value));
  Eigen::Array4f fog = Eigen::Array4f(light[0], light[1], light[2], 0.0f) / 65535.0f;
  fog[3] = static_cast<float>(scale.strength(value));
  return fog;
}

VolumeLayer::VolumeLayer(const Gl& gl, Blending blending)
    : gl_(&gl),
      blending_(blending),
      program_(gl, "field.vert", "volume.frag", blending == Blending::Encoded ? "ENCODED" : ""),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      cells_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindTexture(GL_TEXTURE_3D, cells_.id());
  gl.TexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void VolumeLayer::draw(const Snapshot& snapshot, const View& view, const Projection& projection,
                       const Eye& eye, const ColourScale& scale, GLuint depths) {
  const FieldMap& map = *snapshot.field;
  const Vec3 box = snapshot.box;
  const DrawnRegion slab = drawn_region(snapshot, view.slab, false);
  const Size drawn = projection.drawn();
  fog_.clear();
  for (const double value : map.values) fog_.push_back(fog_of(value, scale));
  gl_->ActiveTexture(GL_TEXTURE1);
  gl_->BindTexture(GL_TEXTURE_2D, depths);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_3D, cells_.id());
  gl_->TexImage3D(GL_TEXTURE_3D, 0, GL_RGBA32F, map.cells[0], map.cells[1], map.cells[2], 0,
                  GL_RGBA, GL_FLOAT, fog_.data());

  program_.use();
  set_eye(*gl_, program_, box, projection, eye);
  set_vector(*gl_, program_, "u_cell",
             box.cwiseQuotient(Vec3(map.cells[0], map.cells[1], map.cells[2])));
  set_vector(*gl_, program_, "u_from", slab.low.cwiseMax(0.0));
  set_vector(*gl_, program_, "u_to", slab.high.cwiseMin(box));
  gl_->Uniform2f(program_.uniform("u_low"), 0.0f, 0.0f);
  gl_->Uniform2f(program_.uniform("u_high"), drawn.width, drawn.height);
  gl_->Uniform1i(program_.uniform("u_cells"), 0);
  gl_->Uniform1i(program_.uniform("u_depths"), 1);
  gl_->Uniform1f(program_.uniform("u_extinction"), view.volume);
  gl_->Uniform1f(program_.uniform("u_nearest"), Eye::kNearest);
  gl_->BindVertexArray(vertices_.id());
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  encode_light(*gl_, blending_ == Blending::Light);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  encode_light(*gl_, false);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace clatter
