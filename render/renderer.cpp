#include "render/renderer.h"

#include "render/quantity.h"
#include "render/theme.h"

namespace clatter {

namespace {

// Alpha of a heatmap's colours below disks that have colours of their own.
constexpr std::uint8_t kBelowColouredDisks = 115;

// Without its darkest eighth: slow disks would be lost against the background.
ColourMap disk_map(const View& view) {
  if (quantity_of(view.colour_by).sign == Sign::Either) return diverging_map();
  return colour_map(view.palette).subspan(2);
}

ColourMap field_map(Field field, const View& view) {
  if (quantity_of(field).sign == Sign::Either) return diverging_map();
  return colour_map(view.field_palette.value_or(view.palette));
}

// The map's first colour stands for the least magnitude, or for the least value of either sign.
ColourScale scale_from(double low, double high, Sign sign, ColourMap map) {
  switch (sign) {
    case Sign::Positive:
      return {map, low, high};
    case Sign::Negative:
      return {map, high, low};
    case Sign::Either:
      return {.map = map, .low = low, .high = high, .about_zero = true};
  }
  return {map};
}

ColourScale scale_to(double extent, Sign sign, ColourMap map) {
  return scale_from(sign == Sign::Positive ? 0.0 : -extent, sign == Sign::Negative ? 0.0 : extent,
                    sign, map);
}

double disk_extent(const Snapshot& snapshot, ColourBy colour_by) {
  std::vector<double> values(snapshot.positions.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = disk_value(snapshot, colour_by, i);
  return robust_extent(std::move(values));
}

bool shows_field(const Snapshot& snapshot, const View& view) {
  return view.field && snapshot.field;
}

}  // namespace

Renderer::Renderer(const Gl& gl) : gl_(&gl), field_(gl), walls_(gl), disks_(gl), overlay_(gl) {}

Legend Renderer::Followed::legend(const Quantity& shown, const ColourRange& range, ColourMap map,
                                  double robust_extent, bool lockable) {
  if (range.kind == ColourRange::Given) {
    return {shown, scale_from(range.ends[0], range.ends[1], shown.sign, map), "given"};
  }
  if (!(quantity == shown)) *this = {shown, {}};
  const bool lock = range.kind == ColourRange::Locked && lockable;
  const double end = extent.follow(robust_extent, lock);
  return {shown, scale_to(end, shown.sign, map), extent.held() ? "locked" : "auto"};
}

std::vector<Legend> Renderer::Legends::all() const {
  std::vector<Legend> list;
  for (const auto& legend : {disks, field}) {
    if (legend) list.push_back(*legend);
  }
  return list;
}

Renderer::Legends Renderer::legends_for(const Snapshot& snapshot, const View& view) {
  Legends legends;
  if (view.colour_by != ColourBy::None) {
    legends.disks = disk_range_.legend(quantity_of(view.colour_by), view.range, disk_map(view),
                                       disk_extent(snapshot, view.colour_by), true);
  }
  if (shows_field(snapshot, view)) {
    const FieldMap& map = *snapshot.field;
    legends.field =
        field_range_.legend(quantity_of(map.field), view.field_range, field_map(map.field, view),
                            robust_extent(map.values), map.whole_window);
    if (legends.disks) legends.field->scale.opacity = kBelowColouredDisks;
  }
  return legends;
}

Camera Renderer::fit(const Snapshot& snapshot, Size size, const View& view,
                     const OverlayText& text) {
  // Disks stand out of a periodic border by half their diameter.
  Vec2 overhang(0.0, 0.0);
  for (int axis : {0, 1}) {
    if (!snapshot.walls[2 * axis]) overhang[axis] = 0.5 * snapshot.diameter;
  }
  const Faces faces = outermost_faces(snapshot);
  const double wall = wall_thickness(size);
  Margins margins{wall, wall, wall, wall};
  if (view.overlay) {
    margins = overlay_.margins(snapshot, size, legends_for(snapshot, view).all(), text);
  }
  return Camera::fit(faces.low - overhang, faces.high + overhang, size, margins);
}

void Renderer::draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
                    const OverlayText& text) {
  const Projection projection{camera, size};
  const Legends legends = legends_for(snapshot, view);
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->ClearColor(theme::kBackground.red / 255.0f, theme::kBackground.green / 255.0f,
                  theme::kBackground.blue / 255.0f, 1.0f);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  if (legends.field) {
    field_.draw(*snapshot.field, snapshot.box, projection, legends.field->scale);
  }
  walls_.draw(snapshot, projection);
  disks_.draw(snapshot, projection, view.colour_by,
              legends.disks ? legends.disks->scale : ColourScale{});
  if (view.overlay) overlay_.draw(snapshot, projection, legends.all(), text);
}

}  // namespace clatter
