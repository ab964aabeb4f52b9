#include "render/layers/volume_layer.h"

#include <cmath>

#include "render/drawn_region.h"
#include "render/layers/eye_uniforms.h"

namespace clatter {

// The light of a cell. The last channel is its share of the largest extinction coefficient.
static Light fog_of(double value, const ColourScale& scale) {
  if (std::isnan(value)) return {0, 0, 0, 0};
  Light fog = light_of(scale(value));
  fog[3] = static_cast<std::uint16_t>(std::lround(65535.0 * scale.strength(value)));
  return fog;
}

VolumeLayer::VolumeLayer(const Gl& gl, Blending blending)
    : gl_(&gl),
      blending_(blending),
      program_(gl, "field.vert", "volume.frag"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      cells_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindTexture(GL_TEXTURE_3D, cells_.id());
  gl.TexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
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
  gl_->TexImage3D(GL_TEXTURE_3D, 0, GL_RGBA16, map.cells[0], map.cells[1], map.cells[2], 0, GL_RGBA,
                  GL_UNSIGNED_SHORT, fog_.data());

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
  gl_->Uniform1i(program_.uniform("u_encoded"), blending_ == Blending::Encoded);
  gl_->Uniform1f(program_.uniform("u_extinction"), view.volume);
  gl_->Uniform1f(program_.uniform("u_nearest"), Eye::kNearest);
  gl_->BindVertexArray(vertices_.id());
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (blending_ == Blending::Light) gl_->Enable(GL_FRAMEBUFFER_SRGB);
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_->Disable(GL_FRAMEBUFFER_SRGB);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace clatter
