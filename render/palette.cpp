#include "render/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clatter {

namespace {

using ColourMapCode = std::array<std::uint32_t, std::tuple_size_v<ColourMap>>;

constexpr ColourMap colours(const ColourMapCode& rgb) {
  ColourMap result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = {static_cast<std::uint8_t>(rgb[i] >> 16), static_cast<std::uint8_t>(rgb[i] >> 8),
                 static_cast<std::uint8_t>(rgb[i])};
  }
  return result;
}

// Viridis and inferno of N. J. Smith, S. van der Walt and E. Firing, dedicated to the public domain
// (https://bids.github.io/colormap), sampled at 17 equal steps.
constexpr auto kViridis = colours({0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d,
                                   0x2c728e, 0x26818e, 0x21908c, 0x1f9f88, 0x28ae80, 0x3ebc74,
                                   0x5dc963, 0x82d34c, 0xabdc32, 0xd5e21a, 0xfde725});
constexpr auto kInferno = colours({0x000004, 0x0b0724, 0x210c4a, 0x3c0965, 0x57106d, 0x70196e,
                                   0x89226a, 0xa32b61, 0xbb3755, 0xd14644, 0xe35932, 0xf1711e,
                                   0xf98d0a, 0xfcab0f, 0xf9ca32, 0xf2e865, 0xfcffa4});

// J. R. Nuñez, C. R. Anderton and R. S. Renslow, "Optimizing colormaps with consideration for color
// vision deficiency" (2018), sampled at 17 equal steps.
constexpr auto kCividis = colours({0x00224e, 0x002e6a, 0x1a386f, 0x32436d, 0x434e6c, 0x52596d,
                                   0x61656f, 0x6f7073, 0x7c7b78, 0x8b8778, 0x9b9376, 0xaba072,
                                   0xbbad6c, 0xccba64, 0xddc958, 0xefd748, 0xfee838});

// K. Moreland, "Diverging Color Maps for Scientific Visualization" (2009): Msh interpolation from
// (59, 76, 192) to (180, 4, 38), evaluated at 17 equal steps.
constexpr auto kCoolWarm = colours({0x3b4cc0, 0x4e68d7, 0x6282ea, 0x779af7, 0x8db0fe, 0xa3c2fe,
                                    0xb8d0f9, 0xccd9ee, 0xdddddd, 0xecd3c6, 0xf5c4ad, 0xf7b194,
                                    0xf49a7b, 0xec7f63, 0xde614c, 0xcb3e38, 0xb40426});

}  // namespace

float linear_light(std::uint8_t channel) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> light;
    for (int i = 0; i < 256; ++i) {
      const double c = i / 255.0;
      light[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return light;
  }();
  return table[channel];
}

std::uint8_t encoded_light(double light) {
  const double c = std::clamp(light, 0.0, 1.0);
  const double channel = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * channel));
}

double luminance(Colour colour) {
  return 0.2126 * linear_light(colour.red) + 0.7152 * linear_light(colour.green) +
         0.0722 * linear_light(colour.blue);
}

double contrast_ratio(Colour a, Colour b) {
  const auto [darker, lighter] = std::minmax({luminance(a), luminance(b)});
  return (lighter + 0.05) / (darker + 0.05);
}

Colour mix(Colour a, Colour b, double t) {
  // lround() is a call of a function, and fields have a million channels a picture.
  auto channel = [t](int from, int to) {
    return static_cast<std::uint8_t>(from + t * (to - from) + 0.5);
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue),
          channel(a.alpha, b.alpha)};
}

ColourMap colour_map(Palette palette) {
  switch (palette) {
    case Palette::Viridis:
      return kViridis;
    case Palette::Inferno:
      return kInferno;
    case Palette::Cividis:
      return kCividis;
  }
  return {};
}

ColourMap diverging_map() {
  return kCoolWarm;
}

double ColourScale::place(double value) const {
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  if (!about_zero) return share;
  const double shown = low + share * (high - low);
  return 0.5 + 0.5 * shown / std::max(std::abs(low), std::abs(high));
}

double ColourScale::strength(double value) const {
  return about_zero ? std::abs(2.0 * place(value) - 1.0) : place(value);
}

Colour ColourScale::operator()(double value) const {
  const double steps = static_cast<double>(map.size() - 1) * place(value);
  const std::size_t index = std::min(static_cast<std::size_t>(steps), map.size() - 2);
  return mix(map[index], map[index + 1], steps - static_cast<double>(index));
}

}  // namespace clatter
