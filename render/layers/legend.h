#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/species.h"
#include "render/label.h"
#include "render/layers/arrow_layer.h"
#include "render/palette.h"
#include "render/typography/fonts.h"

namespace clatter {

/// Legend of a colour scale.
struct Legend {
  Label label;
  ColourScale scale;
  std::string range;  ///< origin of the ends of the scale: "auto", "locked" or "given"
};

/// Legend of the length of arrows.
struct ArrowLegend {
  Label label;
  double pixels = 1.0;  ///< pixels per unit of value; AutoRanges::legends: length in the scene
};

/// Legend of the colours and sizes of species.
struct SpeciesLegend {
  std::vector<Species> species;
  std::vector<Colour> colours;  ///< [species]
};

/// All legends of a picture.
struct Legends {
  std::optional<Legend> disks, field;
  std::optional<ArrowLegend> arrows;
  std::optional<SpeciesLegend> species = {};

  /// The legends with a colour bar, from top to bottom.
  std::vector<Legend> bars() const;
};

/// Width of the widest legend in pixels; 0: no legends.
float legend_width(const Legends& legends, const Fonts& fonts);

/// The upper left and the lower right corner of the bar that draw_legend() draws.
std::pair<ImVec2, ImVec2> legend_bar(const Fonts& fonts, ImVec2 place, float height);

/// Draws a legend as a vertical bar, with name, unit and range above. Its total height is `height`
/// pixels.
void draw_legend(ImDrawList& list, const Legend& legend, const Fonts& fonts,
                 const ThemeColours& theme, ImVec2 place, float height);

/// The legend with as many species, from the first on, as fit into a height in pixels; at least
/// one.
SpeciesLegend fitting(SpeciesLegend legend, const Fonts& fonts, float height);

/// Height of the legend of species in pixels.
float species_legend_height(const SpeciesLegend& legend, const Fonts& fonts);

/// Draws a legend of species: a disk of each colour with the name and the diameters of the species.
/// The disks have the ratios of the diameters. A long name is cut.
void draw_species_legend(ImDrawList& list, const SpeciesLegend& legend, const Fonts& fonts,
                         const ThemeColours& theme, ImVec2 place);

/// Height of the legend of arrows in pixels.
float arrow_legend_height(const Fonts& fonts);

/// Draws a legend of arrows: name, an arrow of `shape`, and the round value of its length.
void draw_arrow_legend(ImDrawList& list, const ArrowLegend& legend, const Fonts& fonts,
                       const ThemeColours& theme, const ArrowShape& shape, ImVec2 place);

}  // namespace clatter
