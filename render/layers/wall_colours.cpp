#include "render/layers/wall_colours.h"

#include <cmath>

namespace clatter {

Colour WallColours::of(const Wall& wall) const {
  if (wall.kind == WallKind::Static) return theme.static_wall;
  if (wall.kind != WallKind::Thermal) return theme.driven_wall;
  if (speeds) return (*speeds)(std::sqrt(dimension * wall.temperature));
  return temperatures ? (*temperatures)(wall.temperature) : theme.static_wall;
}

WallColours wall_colours(const ThemeColours& theme, const Legends& legends, const View& view,
                         int dimension) {
  WallColours colours{.theme = theme, .dimension = dimension};
  if (legends.disks && view.colour_by == ColourBy::Speed) colours.speeds = legends.disks->scale;
  if (legends.field && view.field->quantity == Quantity::Temperature) {
    colours.temperatures = legends.field->scale;
  }
  return colours;
}

}  // namespace clatter
