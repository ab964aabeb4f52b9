#include "render/layers/field_layer.h"

#include <algorithm>
#include <cmath>

namespace clatter {

FieldLayer::FieldLayer(const Gl& gl)
    : gl_(&gl),
      smooth_(gl, "field.vert", "field.frag"),
      hatched_(gl, "field.vert", "field.frag", "HATCHED"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      texture_(gl) {}

PlaneMap plane_of(const Snapshot& snapshot) {
  const FieldMap& map = *snapshot.field;
  return {
      map.cells[0], map.cells[1], {!snapshot.walls[kLeft], !snapshot.walls[kBottom]}, map.values};
}

FieldStyle style_of(Field field, const View& view) {
  return is_residual(field) ? FieldStyle::Cells : view.field_style;
}

bool has_values(const FieldMap& map) {
  return !std::ranges::all_of(map.values, [](double value) { return std::isnan(value); });
}

void FieldLayer::draw(const Snapshot& snapshot, const Projection& projection,
                      const ColourScale& scale, FieldStyle style, Colour gap,
                      const Tiling& tiling) {
  texture_.bind(plane_of(snapshot), scale, style);
  const Size size = projection.size, drawn = projection.drawn();
  const Program& program = style == FieldStyle::Cells ? hatched_ : smooth_;
  program.use();
  gl_->Uniform2f(program.uniform("u_size"), drawn.width, drawn.height);
  gl_->Uniform1i(program.uniform("u_cells"), 0);
  set_colour(*gl_, program, "u_gap", gap);
  gl_->Uniform1f(
      program.uniform("u_period"),
      projection.samples * std::max(5.0, std::round(std::min(size.width, size.height) / 90.0)));
  gl_->BindVertexArray(vertices_.id());
  const auto draw_copy = [&](int x, int y, float opacity) {
    const Vec2 low = projection.pixels(snapshot.box.cwiseProduct(Vec2(x, y)));
    const Vec2 high = projection.pixels(snapshot.box.cwiseProduct(Vec2(x + 1, y + 1)));
    gl_->Uniform2f(program.uniform("u_low"), low.x(), low.y());
    gl_->Uniform2f(program.uniform("u_high"), high.x(), high.y());
    gl_->Uniform1f(program.uniform("u_opacity"), opacity);
    gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  };
  draw_copy(0, 0, 1.0f);
  gl_->Enable(GL_BLEND);  // opaque colours of the box need none, see FieldTexture
  for (int y = tiling.first[1]; y <= tiling.last[1]; ++y) {
    for (int x = tiling.first[0]; x <= tiling.last[0]; ++x) {
      if (x != 0 || y != 0) draw_copy(x, y, tiling.faintness);
    }
  }
  texture_.unbind();
}

}  // namespace clatter
