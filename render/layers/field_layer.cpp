#include "render/layers/field_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace clatter {

FieldTexture::FieldTexture(const Gl& gl)
    : gl_(&gl), cells_(generate<Texture>(gl, gl.GenTextures)) {}

static Colour premultiplied(Colour colour, double opacity) {
  return opacity == 1.0 ? colour : mix({0, 0, 0, 0}, colour, opacity);
}

void FieldTexture::bind(const PlaneMap& map, const ColourScale& scale, FieldStyle style) {
  const bool smooth = style == FieldStyle::Smooth;
  colours_.clear();
  if (smooth) {
    const SmoothMap drawn = smoothed(map);
    for (std::size_t i = 0; i < drawn.values.size(); ++i) {
      const double share = drawn.shares[i];
      colours_.push_back(share > 0.0 ? premultiplied(scale(drawn.values[i]), share)
                                     : Colour{0, 0, 0, 0});
    }
  } else {
    for (const double value : map.values) {
      colours_.push_back(std::isnan(value) ? Colour{0, 0, 0, 0} : scale(value));
    }
  }
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, cells_.id());
  const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  const auto wrap = [&](int axis) { return map.periodic[axis] ? GL_REPEAT : GL_CLAMP_TO_EDGE; };
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap(0));
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap(1));
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, map.width, map.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  colours_.data());
  // Opaque colours need no blending, which takes much of the time on a processor.
  const bool opaque = std::ranges::all_of(colours_, [](Colour c) { return c.alpha == 255; });
  if (opaque) gl_->Disable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void FieldTexture::unbind() const {
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

FieldLayer::FieldLayer(const Gl& gl)
    : gl_(&gl),
      smooth_(gl, "field.vert", "field.frag"),
      hatched_(gl, "field.vert", "field.frag", "HATCHED"),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      texture_(gl) {}

// Whether cells at both ends of an axis are neighbours. At the sheared border others are.
static bool wraps(const Snapshot& snapshot, int axis) {
  const bool slides = axis == 1 && (snapshot.slide != 0.0 || snapshot.offset != 0.0);
  return !snapshot.walls[2 * axis] && !slides;
}

PlaneMap plane_of(const Snapshot& snapshot) {
  const FieldMap& map = *snapshot.field;
  return {map.cells[0], map.cells[1], {wraps(snapshot, 0), wraps(snapshot, 1)}, map.values};
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
  const auto draw_copy = [&](double x, int y, float opacity) {
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
    // Copies above and below in a sheared box have slid.
    const double lengths = y * snapshot.offset / snapshot.box[0];
    const double slid = lengths - std::floor(lengths);
    for (int x = tiling.first[0] - (slid > 0.0 ? 1 : 0); x <= tiling.last[0]; ++x) {
      if (x != 0 || y != 0) draw_copy(x + slid, y, tiling.faintness);
    }
  }
  texture_.unbind();
}

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
  PlaneMap plane{
      map.cells[first], map.cells[second], {wraps(snapshot, first), wraps(snapshot, second)}};
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
