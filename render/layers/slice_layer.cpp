#include "render/layers/slice_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace clatter {

std::vector<Slice> slices_of(const Snapshot& snapshot, const View& view) {
  if (!view.slices.empty() || view.volume > 0.0) return view.slices;
  return {{Axis::Z, 0.5 * snapshot.box.z()}};
}

SliceLayer::SliceLayer(const Gl& gl)
    : gl_(&gl), faces_(gl, "field.frag", "HATCHED"), texture_(gl) {}

// The layer of cells across an axis.
static PlaneMap layer_of(const Snapshot& snapshot, int axis, int layer) {
  const FieldMap& map = *snapshot.field;
  const auto [first, second] = others_of(axis);
  const std::array<std::size_t, 3> strides = {
      1, static_cast<std::size_t>(map.cells[0]),
      static_cast<std::size_t>(map.cells[0]) * static_cast<std::size_t>(map.cells[1])};
  PlaneMap plane{map.cells[first],
                 map.cells[second],
                 {!snapshot.walls[2 * first], !snapshot.walls[2 * second]}};
  for (int j = 0; j < map.cells[second]; ++j) {
    for (int i = 0; i < map.cells[first]; ++i) {
      plane.values.push_back(
          map.values[layer * strides[axis] + i * strides[first] + j * strides[second]]);
    }
  }
  return plane;
}

// The mean of the layers at and beside a layer, with weights (1 2 1)/4, over cells with a value.
static PlaneMap mean_layer(const Snapshot& snapshot, int axis, int layer) {
  const int last = snapshot.field->cells[axis] - 1;
  PlaneMap plane = layer_of(snapshot, axis, layer);
  const PlaneMap below = layer_of(snapshot, axis, std::max(layer - 1, 0));
  const PlaneMap above = layer_of(snapshot, axis, std::min(layer + 1, last));
  for (std::size_t i = 0; i < plane.values.size(); ++i) {
    double sum = 0.0, weights = 0.0;
    for (const auto& [value, weight] :
         {std::pair(below.values[i], 1.0), {plane.values[i], 2.0}, {above.values[i], 1.0}}) {
      if (std::isnan(value)) continue;
      sum += weight * value;
      weights += weight;
    }
    plane.values[i] = sum / weights;
  }
  return plane;
}

void SliceLayer::draw(const Snapshot& snapshot, const std::vector<Slice>& slices,
                      const Projection& projection, const Eye& eye, const ColourScale& scale,
                      FieldStyle style, Colour gap) {
  const FieldMap& map = *snapshot.field;
  const Program& program = faces_.use(snapshot.box, projection, eye);
  const Size size = projection.size;
  gl_->Uniform1i(program.uniform("u_cells"), 0);
  gl_->Uniform1f(program.uniform("u_opacity"), 1.0f);
  set_colour(*gl_, program, "u_gap", gap);
  gl_->Uniform1f(
      program.uniform("u_period"),
      projection.samples * std::max(5.0, std::round(std::min(size.width, size.height) / 90.0)));
  for (const Slice& slice : slices) {
    const auto axis = static_cast<int>(slice.axis);
    const auto [first, second] = others_of(axis);
    const double share = slice.position / snapshot.box[axis];
    const int layer = std::clamp(static_cast<int>(share * map.cells[axis]), 0, map.cells[axis] - 1);
    texture_.bind(style == FieldStyle::Smooth ? mean_layer(snapshot, axis, layer)
                                              : layer_of(snapshot, axis, layer),
                  scale, style);
    faces_.draw(
        {axis, slice.position, Vec2(0.0, 0.0), Vec2(snapshot.box[first], snapshot.box[second])},
        eye, Vec2(1.0, 1.0));
    texture_.unbind();
  }
}

}  // namespace clatter
