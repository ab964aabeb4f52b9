#pragma once

#include "render/palette.h"

// Colours follow from the ground, the colour of the background (contrast_maps.h). Zero of a field
// is the ground itself, and its largest value has twice the contrast. The slowest particle has a
// contrast ratio of at least 3 to every field. A smooth field is a mean of neighbouring cells
// (plane_map.h), which the texture unit interpolates. Files have the exact cells. The colours of
// thermal walls are on the shown scale of speeds (WallColours).

namespace clatter {

/// Colour maps that depend on the ground, the colour of the background. A field rises from the
/// ground in few steps of lightness. Every particle differs from its ground, and the slowest
/// particle differs from every field by a contrast ratio of 3 at least.

/// For magnitudes of particles: the hues of the palette. Particles are lighter than a dark ground
/// and darker than a light one, the faster the lighter.
ColourMap particle_map(Palette palette, Colour ground);

/// For signed values of particles: blue below zero, grey at zero, red above.
ColourMap signed_particle_map(Colour ground);

/// A colour with the hue of `hue` for particles of one kind. `share` is its place between the
/// slowest and the fastest particle in equal steps of lightness, 0 to 1.
Colour particle_colour(Colour hue, double share, Colour ground);

/// For magnitudes of fields: the ground at zero, then the hues of the palette.
ColourMap field_map(FieldPalette palette, Colour ground);

/// For signed fields: blue below zero, the ground at zero, red above.
ColourMap signed_field_map(Colour ground);

}  // namespace clatter
