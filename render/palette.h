#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/scene/view.h"

namespace clatter {

/// A colour in sRGB, in the byte order of GL_RGBA and of Image.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t alpha = 255;

  bool operator==(const Colour&) const = default;
};

/// The light that a channel of a colour stands for, as a share of the most, IEC 61966-2-1.
float linear_light(std::uint8_t channel);

/// The colour a share `t` in 0..1 of the way from `a` to `b`.
Colour mix(Colour a, Colour b, double t);

/// Colours at equal steps from the lowest to the highest value; linear between them.
using ColourMap = std::span<const Colour>;

/// The map of a palette: viridis, inferno or cividis.
ColourMap colour_map(Palette palette);

/// For signed values: blue below zero, grey at zero, red above.
ColourMap diverging_map();

/// From values to colours.
struct ColourScale {
  ColourMap map;
  double low = 0.0;            ///< the value at the map's first colour
  double high = 1.0;           ///< the value at its last, other than low
  bool about_zero = false;     ///< the map's middle stands for 0, whatever the ends
  std::uint8_t opacity = 255;  ///< alpha of its colours

  /// The colour of `value`; beyond the ends, that of the end.
  Colour operator()(double value) const;
};

}  // namespace clatter
