#pragma once

#include "engine/scene/view.h"
#include "render/palette.h"

namespace clatter {

/// The colours of text: the glyphs, and the halo that keeps them legible.
struct Ink {
  Colour colour;
  Colour halo;
};

/// The colours of everything that does not show a value.
struct ThemeColours {
  Colour background;
  Colour text;
  Colour faint_text;
  Colour disk;         ///< disks with ColourBy::None
  Colour static_wall;  ///< static walls, periodic borders and lines
  Colour driven_wall;

  /// Ink of the main text.
  Ink ink() const { return {text, background}; }
  /// Ink of secondary text.
  Ink faint_ink() const { return {faint_text, background}; }
};

inline constexpr ThemeColours kDarkTheme = {{0x10, 0x14, 0x18}, {0xe6, 0xea, 0xee},
                                            {0x8c, 0x96, 0xa0}, {0xb4, 0xc0, 0xcc},
                                            {0x78, 0x82, 0x8c}, {0xf2, 0xa6, 0x3c}};
inline constexpr ThemeColours kLightTheme = {{0xf4, 0xf6, 0xf8}, {0x1c, 0x22, 0x28},
                                             {0x5c, 0x66, 0x70}, {0x4c, 0x58, 0x66},
                                             {0x74, 0x7e, 0x88}, {0xc8, 0x74, 0x10}};
/// High contrast, for dim projectors.
inline constexpr ThemeColours kProjectorTheme = {{0xff, 0xff, 0xff}, {0x00, 0x00, 0x00},
                                                 {0x24, 0x24, 0x24}, {0x40, 0x48, 0x50},
                                                 {0x30, 0x38, 0x40}, {0xb8, 0x50, 0x00}};

/// The colours of the view's theme. The background of the view, if set, replaces that of the theme.
ThemeColours theme_of(const View& view);

}  // namespace clatter
