#pragma once

#include <optional>

#include "engine/laws/wall.h"
#include "render/layers/legend.h"
#include "render/theme.h"

namespace clatter {

/// The colours of walls in a picture.
struct WallColours {
  ThemeColours theme;
  std::optional<ColourScale> speeds = {};        ///< shown scale of speeds; absent: none
  std::optional<ColourScale> temperatures = {};  ///< shown scale of temperatures; absent: none
  int dimension = 2;                             ///< of the box

  /// The colour of a wall. A thermal wall has the colour of the root-mean-square speed of a gas at
  /// its temperature on the scale of speeds. Without this scale it has the colour of its
  /// temperature, and without both that of static walls.
  Colour of(const Wall& wall) const;
};

/// The colours of walls beside these legends.
WallColours wall_colours(const ThemeColours& theme, const Legends& legends, const View& view,
                         int dimension);

}  // namespace clatter
