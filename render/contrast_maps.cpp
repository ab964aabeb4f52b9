#include "render/contrast_maps.h"

#include <algorithm>
#include <cmath>

namespace clatter {

namespace {

constexpr double kFieldContrast = 2.0;     // of the end of a field to the ground
constexpr double kParticleContrast = 3.1;  // of the slowest particle to the end of a field
constexpr double kFlare = 0.05;            // added to luminances in contrast ratios (WCAG 2.1)
constexpr Colour kBlue = {0x3f, 0x8f, 0xd8}, kRed = {0xd8, 0x50, 0x3c}, kGrey = {0x80, 0x80, 0x80};
constexpr std::size_t kMiddle = std::tuple_size_v<ColourMap> / 2;
constexpr std::size_t kLast = std::tuple_size_v<ColourMap> - 1;

// The luminances of a picture.
struct Tones {
  double ground;
  double field;             // at the end of a field
  double slowest, fastest;  // of particles
};

Tones tones_of(Colour ground) {
  // Black and white have the same contrast to a ground of this luminance.
  constexpr double kNeutral = 0.179;
  const double own = luminance(ground);
  Tones tones{own, 0.0, 0.0, 0.0};
  if (own < kNeutral) {
    tones.field = kFieldContrast * (own + kFlare) - kFlare;
    tones.slowest = std::min(kParticleContrast * (tones.field + kFlare) - kFlare, 0.9);
    tones.fastest = std::max(tones.slowest, 0.8);
  } else {
    tones.field = std::max((own + kFlare) / kFieldContrast - kFlare, 0.0);
    tones.slowest = std::clamp((tones.field + kFlare) / kParticleContrast - kFlare, 0.0, 0.025);
    tones.fastest = std::max((own + kFlare) / 4.0 - kFlare, tones.slowest);
  }
  return tones;
}

// The luminance at equal steps of lightness.
double luminance_between(double from, double to, double share) {
  return std::pow(std::lerp(std::cbrt(from), std::cbrt(to), share), 3.0);
}

// The colour scaled to a luminance. A dark colour is scaled up to `kVivid`, then mixed with white.
Colour toned(Colour colour, double to) {
  constexpr double kVivid = 0.85;  // light of the strongest channel
  const double own = luminance(colour);
  const double strongest = linear_light(std::max({colour.red, colour.green, colour.blue}));
  const double scale = std::min(to / own, std::max(kVivid / strongest, 1.0));
  const double white = std::max((to - scale * own) / (1.0 - scale * own), 0.0);
  const auto channel = [&](std::uint8_t value) {
    return encoded_light(std::lerp(scale * linear_light(value), 1.0, white));
  };
  return {channel(colour.red), channel(colour.green), channel(colour.blue)};
}

// Linear interpolation of light, from `a` to `b`.
Colour blend(Colour a, Colour b, double share) {
  const auto channel = [&](std::uint8_t from, std::uint8_t to) {
    const double light_from = linear_light(from), light_to = linear_light(to);
    return encoded_light(std::lerp(light_from, light_to, share));
  };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

// The colour between ground and `end` at a share of the steps of lightness.
Colour risen(Colour ground, Colour end, double share) {
  const double from = luminance(ground), to = luminance(end);
  return blend(ground, end, (luminance_between(from, to, share) - from) / (to - from));
}

// `middle` in the middle, and both ends in its steps of lightness.
ColourMap signed_map(Colour low, Colour middle, Colour high) {
  ColourMap map;
  for (std::size_t i = 0; i <= kLast; ++i) {
    const double share = (static_cast<double>(i) - kMiddle) / kMiddle;
    map[i] = risen(middle, share < 0.0 ? low : high, std::abs(share));
  }
  return map;
}

ColourMap hues_of(FieldPalette palette) {
  ColourMap uniform;
  switch (palette) {
    case FieldPalette::Blue:
      uniform.fill(kBlue);
      return uniform;
    case FieldPalette::Grey:
      uniform.fill(kGrey);
      return uniform;
    case FieldPalette::Viridis:
      return colour_map(Palette::Viridis);
    case FieldPalette::Inferno:
      return colour_map(Palette::Inferno);
    case FieldPalette::Cividis:
      return colour_map(Palette::Cividis);
  }
  return uniform;
}

}  // namespace

ColourMap particle_map(Palette palette, Colour ground) {
  constexpr std::size_t kBlack = 3;  // the colours before have hardly any hue
  const Tones tones = tones_of(ground);
  const ColourMap hues = colour_map(palette);
  ColourMap map;
  for (std::size_t i = 0; i <= kLast; ++i) {
    const double share = static_cast<double>(i) / kLast;
    map[i] =
        toned(hues[std::max(i, kBlack)], luminance_between(tones.slowest, tones.fastest, share));
  }
  return map;
}

Colour particle_colour(Colour hue, double share, Colour ground) {
  const Tones tones = tones_of(ground);
  return toned(hue, luminance_between(tones.slowest, tones.fastest, share));
}

ColourMap signed_particle_map(Colour ground) {
  const Tones tones = tones_of(ground);
  const bool dark = tones.ground < tones.slowest;
  const double end = dark ? tones.slowest : tones.fastest;
  const double middle = dark ? tones.fastest : tones.slowest;
  return signed_map(toned(kBlue, end), toned(kGrey, middle), toned(kRed, end));
}

ColourMap field_map(FieldPalette palette, Colour ground) {
  const double end = tones_of(ground).field;
  const ColourMap hues = hues_of(palette);
  ColourMap map;
  for (std::size_t i = 0; i <= kLast; ++i) {
    map[i] = risen(ground, toned(hues[i], end), static_cast<double>(i) / kLast);
  }
  return map;
}

ColourMap signed_field_map(Colour ground) {
  const double end = tones_of(ground).field;
  return signed_map(toned(kBlue, end), ground, toned(kRed, end));
}

}  // namespace clatter
