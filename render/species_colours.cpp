#include "render/species_colours.h"

#include <array>

#include "render/contrast_maps.h"

namespace clatter {

namespace {

struct SpeciesHue {
  Colour hue;
  double share;  // of the range of lightness
};

// The hues of M. Okabe and K. Ito, "Color Universal Design" (2008), and grey. Each has a lightness
// of its own, because the ground restricts it, and because hues alone do not suffice for the
// colour-blind.
constexpr std::array<SpeciesHue, 8> kSpeciesHues = {{{{0x00, 0x72, 0xb2}, 0.15},
                                                     {{0xe6, 0x9f, 0x00}, 0.35},
                                                     {{0x00, 0x9e, 0x73}, 1.00},
                                                     {{0xf0, 0xe4, 0x42}, 0.95},
                                                     {{0xcc, 0x79, 0xa7}, 0.05},
                                                     {{0x80, 0x80, 0x80}, 0.45},
                                                     {{0x56, 0xb4, 0xe9}, 0.60},
                                                     {{0xd5, 0x5e, 0x00}, 0.00}}};

}  // namespace

std::vector<Colour> species_colours(const std::vector<Species>& species, Colour ground) {
  std::vector<Colour> colours;
  for (std::size_t k = 0; k < species.size(); ++k) {
    const auto& [hue, share] = kSpeciesHues[k % kSpeciesHues.size()];
    const auto& own = species[k].colour;
    colours.push_back(own ? Colour{own->red, own->green, own->blue}
                          : particle_colour(hue, share, ground));
  }
  return colours;
}

}  // namespace clatter
