#pragma once

#include <array>
#include <cstdint>

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

/// Linear light of an sRGB channel, 0..1 (IEC 61966-2-1).
float linear_light(std::uint8_t channel);

/// The sRGB channel of linear light; light is clamped to 0..1.
std::uint8_t encoded_light(double light);

/// Relative luminance of a colour: 0 of black, 1 of white (WCAG 2.1).
double luminance(Colour colour);

/// Contrast ratio of two colours: 1 to 21 (WCAG 2.1).
double contrast_ratio(Colour a, Colour b);

/// Linear interpolation between `a` (t = 0) and `b` (t = 1) in sRGB.
Colour mix(Colour a, Colour b, double t);

/// Colours at equal steps from the lowest to the highest value, with linear interpolation.
using ColourMap = std::array<Colour, 17>;

/// The map of a palette: viridis, inferno or cividis.
ColourMap colour_map(Palette palette);

/// For signed values: blue below zero, grey at zero, red above.
ColourMap diverging_map();

/// Mapping from values to colours.
struct ColourScale {
  ColourMap map;
  double low = 0.0;         ///< value of the first colour of the map
  double high = 1.0;        ///< value of the last colour, other than `low`
  bool about_zero = false;  ///< 0 maps to the middle of the map, the larger end to its end

  /// The colour of `value`, clamped to the ends.
  Colour operator()(double value) const;
  /// Magnitude of `value` as a share of the range, 0 to 1: 0 at the first colour, or at zero with
  /// `about_zero`.
  double strength(double value) const;

 private:
  // Position of `value` in the map, 0 to 1.
  double place(double value) const;
};

}  // namespace clatter
