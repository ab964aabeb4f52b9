#include "render/layers/slice_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clatter {

std::vector<Slice> slices_of(const Snapshot& snapshot, const View& view) {
  if (!view.slices.empty() || view.volume > 0.0) return view.slices;
  return {{Axis::Z, 0.5 * snapshot.box.z()}};
}

SliceLayer::SliceLayer(const Gl& gl)
    : gl_(&gl), faces_(gl, "field.frag"), cells_(generate<Texture>(gl, gl.GenTextures)) {
  gl.BindTexture(GL_TEXTURE_2D, cells_.id());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void SliceLayer::draw(const Snapshot& snapshot, const std::vector<Slice>& slices,
                      const Projection& projection, const Eye& eye, const ColourScale& scale,
                      Colour gap) {
  const FieldMap& map = *snapshot.field;
  const Program& program = faces_.use(snapshot.box, projection, eye);
  const Size size = projection.size;
  gl_->Uniform1i(program.uniform("u_cells"), 0);
  set_colour(*gl_, program, "u_gap", gap);
  gl_->Uniform1f(
      program.uniform("u_period"),
      projection.samples * std::max(5.0, std::round(std::min(size.width, size.height) / 90.0)));
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, cells_.id());
  for (const Slice& slice : slices) {
    const auto axis = static_cast<int>(slice.axis);
    const auto [first, second] = others_of(axis);
    const double share = slice.position / snapshot.box[axis];
    const int layer = std::clamp(static_cast<int>(share * map.cells[axis]), 0, map.cells[axis] - 1);
    const std::array<std::size_t, 3> strides = {
        1, static_cast<std::size_t>(map.cells[0]),
        static_cast<std::size_t>(map.cells[0]) * static_cast<std::size_t>(map.cells[1])};
    colours_.clear();
    for (int j = 0; j < map.cells[second]; ++j) {
      for (int i = 0; i < map.cells[first]; ++i) {
        const double value =
            map.values[layer * strides[axis] + i * strides[first] + j * strides[second]];
        colours_.push_back(std::isnan(value) ? Colour{0, 0, 0, 0} : scale(value));
      }
    }
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, map.cells[first], map.cells[second], 0, GL_RGBA,
                    GL_UNSIGNED_BYTE, colours_.data());
    faces_.draw(
        {axis, slice.position, Vec2(0.0, 0.0), Vec2(snapshot.box[first], snapshot.box[second])},
        eye, Vec2(1.0, 1.0));
  }
}

}  // namespace clatter
