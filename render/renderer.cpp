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
    case ColourBy::Spin:
      return {"spin ω", "", true};
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
    case Field::StressXx:
      return {"stress σ", "xx", true};
    case Field::StressYy:
      return {"stress σ", "yy", true};
    case Field::StressXy:
      return {"stress σ", "xy", true};
    case Field::StressXxKinetic:
      return {"kinetic stress σ", "xx", true};
    case Field::StressYyKinetic:
      return {"kinetic stress σ", "yy", true};
    case Field::StressXyKinetic:
      return {"kinetic stress σ", "xy", true};
    case Field::StressXxCollisional:
      return {"collisional stress σ", "xx", true};
    case Field::StressYyCollisional:
      return {"collisional stress σ", "yy", true};
    case Field::StressXyCollisional:
      return {"collisional stress σ", "xy", true};
    case Field::HeatFluxX:
      return {"heat flux q", "x", true};
    case Field::HeatFluxY:
      return {"heat flux q", "y", true};
    case Field::HeatFluxXKinetic:
      return {"kinetic heat flux q", "x", true};
    case Field::HeatFluxYKinetic:
      return {"kinetic heat flux q", "y", true};
    case Field::HeatFluxXCollisional:
      return {"collisional heat flux q", "x", true};
    case Field::HeatFluxYCollisional:
      return {"collisional heat flux q", "y", true};
    case Field::Dissipation:
      return {"dissipation ζ", "", true};
    case Field::Spin:
      return {"mean spin ω", "", true};
    case Field::SpinTemperature:
      return {"spin temperature T", "rot"};
    case Field::BalanceMass:
      return {"mass residual", "", true};
    case Field::BalanceMomentumX:
      return {"momentum residual", "x", true};
    case Field::BalanceMomentumY:
      return {"momentum residual", "y", true};
    case Field::BalanceEnergy:
      return {"energy residual", "", true};
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

Renderer::Scales Renderer::scales_for(const Snapshot& snapshot, const View& view) {
  Scales scales;
  if (view.range) {
    scales.disks = {disk_map(view), (*view.range)[0], (*view.range)[1]};
  } else if (view.colour_by != ColourBy::None) {
    scales.disks = scale_to(disk_extent_.follow(disk_extent(snapshot, view.colour_by)),
                            quantity_of(view.colour_by).is_signed, disk_map(view));
  }
  if (shows_field(snapshot, view)) {
    const Field field = snapshot.field->field;
    scales.field = scale_to(field_extent_.follow(robust_extent(snapshot.field->values)),
                            quantity_of(field).is_signed, field_map(field, view));
  }
  return scales;
}

std::vector<Legend> Renderer::legends(const Snapshot& snapshot, const View& view,
                                      const Scales& scales) {
  std::vector<Legend> result;
  if (view.colour_by != ColourBy::None) {
    const Quantity quantity = quantity_of(view.colour_by);
    result.push_back({quantity.name, quantity.subscript, scales.disks});
  }
  if (shows_field(snapshot, view)) {
    const Quantity quantity = quantity_of(snapshot.field->field);
    result.push_back({quantity.name, quantity.subscript, scales.field});
  }
  return result;
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
    // How much room a legend takes does not depend on its values.
    margins = overlay_.margins(snapshot, size, legends(snapshot, view, {}), text);
  }
  return Camera::fit(faces.low - overhang, faces.high + overhang, size, margins);
}

void Renderer::draw(const Snapshot& snapshot, const Camera& camera, Size size, const View& view,
                    const OverlayText& text) {
  const Projection projection{camera, size};
  const Scales scales = scales_for(snapshot, view);
  gl_->Viewport(0, 0, size.width, size.height);
  gl_->ClearColor(theme::kBackground.red / 255.0f, theme::kBackground.green / 255.0f,
                  theme::kBackground.blue / 255.0f, 1.0f);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  gl_->Enable(GL_BLEND);
  gl_->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  if (shows_field(snapshot, view)) {
    field_.draw(*snapshot.field, snapshot.box, projection, scales.field);
  }
  walls_.draw(snapshot, projection);
  disks_.draw(snapshot, projection, view.colour_by, scales.disks);
  if (view.overlay) overlay_.draw(snapshot, projection, legends(snapshot, view, scales), text);
}

}  // namespace clatter
