#include "render/renderer.h"

#include "render/theme.h"

namespace clatter {

namespace {

// What belongs to a quantity, whatever its values.
struct Quantity {
  const char* name;
  const char* subscript = "";
  bool is_signed = false;
};

Quantity quantity_of(ColourBy colour_by) {
  switch (colour_by) {
    case ColourBy::None:
      return {""};
    case ColourBy::Speed:
      return {"speed |v|"};
    case ColourBy::VelocityX:
      return {"velocity v", "x", true};
    case ColourBy::VelocityY:
      return {"velocity v", "y", true};
  }
  return {""};
}

Quantity quantity_of(Field field) {
  switch (field) {
    case Field::Density:
      return {"density ρ"};
    case Field::VelocityX:
      return {"flow u", "x", true};
    case Field::VelocityY:
      return {"flow u", "y", true};
    case Field::Temperature:
      return {"temperature T"};
    case Field::TemperatureX:
      return {"temperature T", "x"};
    case Field::TemperatureY:
      return {"temperature T", "y"};
  }
  return {""};
}

// Without its darkest eighth: slow disks would be lost against the background.
ColourMap disk_map(const View& view) {
  if (quantity_of(view.colour_by).is_signed) return diverging_map();
  return colour_map(view.palette).subspan(2);
}

// Below coloured disks the field is subdued; where the disks' colour shows nothing it has the
// palette.
ColourMap field_map(Field field, const View& view) {
  if (quantity_of(field).is_signed) return diverging_map();
  return view.colour_by == ColourBy::None ? colour_map(view.palette) : subdued_map();
}

ColourScale scale_to(double extent, bool is_signed, ColourMap map) {
  return {map, is_signed ? -extent : 0.0, extent};
}

}  // namespace

Renderer::Renderer(const Gl& gl) : gl_(&gl), field_(gl), walls_(gl), disks_(gl), overlay_(gl) {}

Camera Renderer::fit(const Snapshot& snapshot, Size size, const View& view,
                     const OverlayText& text) {
  // Disks stand out of a periodic border by half their diameter.
  Vec2 overhang(0.0, 0.0);
  for (int axis : {0, 1}) {
    if (!snapshot.walls[2 * axis]) overhang[axis] = 0.5 * snapshot.diameter;
  }
  const double wall = wall_thickness(size);
  const Margins margins = view.overlay
                              ? overlay_.margins(snapshot.box, size, legends(snapshot, view), text)
                              : Margins{wall, wall, wall, wall};
  return Camera::fit(-overhang, snapshot.box + overhang, size, margins);
}

void Renderer::draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
                    const OverlayText& text) {
  const Projection projection{camera, size};
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->ClearColor(theme::kBackground.red / 255.0f, theme::kBackground.green / 255.0f,
                  theme::kBackground.blue / 255.0f, 1.0f);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  if (view.field && snapshot.field) {
    field_.draw(*snapshot.field, snapshot.box, projection, field_scale(*snapshot.field, view));
  }
  walls_.draw(snapshot, projection);
  disks_.draw(snapshot, projection, view.colour_by, disk_scale(snapshot, view));
  if (view.overlay) overlay_.draw(snapshot, projection, legends(snapshot, view), text);
}

ColourScale Renderer::disk_scale(const Snapshot& snapshot, const View& view) {
  if (view.range) return {disk_map(view), (*view.range)[0], (*view.range)[1]};
  std::vector<double> values(snapshot.positions.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = disk_value(snapshot, view.colour_by, i);
  }
  const double extent = disk_extent_.follow(robust_extent(std::move(values)));
  return scale_to(extent, quantity_of(view.colour_by).is_signed, disk_map(view));
}

ColourScale Renderer::field_scale(const FieldMap& field, const View& view) {
  const double extent = field_extent_.follow(robust_extent(field.values));
  return scale_to(extent, quantity_of(field.field).is_signed, field_map(field.field, view));
}

std::vector<Legend> Renderer::legends(const Snapshot& snapshot, const View& view) {
  std::vector<Legend> result;
  if (view.colour_by != ColourBy::None) {
    const Quantity quantity = quantity_of(view.colour_by);
    result.push_back({quantity.name, quantity.subscript, disk_scale(snapshot, view)});
  }
  if (view.field && snapshot.field) {
    const Quantity quantity = quantity_of(snapshot.field->field);
    result.push_back({quantity.name, quantity.subscript, field_scale(*snapshot.field, view)});
  }
  return result;
}

}  // namespace clatter
