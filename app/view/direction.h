#pragma once

#include <array>

#include "engine/scene/view.h"

namespace clatter {

/// A direction of view for spheres, with its button and its key.
struct Preset {
  char key;  ///< lower-case letter of the key
  const char* label;
  const char* help;
  double azimuth, elevation;
};

/// Along each axis, and from a corner of the box.
inline constexpr std::array<Preset, 4> kPresets = {
    {{'x', "x", "From the right, along x (X)", 90.0, 0.0},
     {'y', "y", "From above, along y (Y)", 0.0, 90.0},
     {'z', "z", "From the front, along z (Z)", 0.0, 0.0},
     {'i', "iso", "Isometric: from a corner, with equal lengths along all axes (I)", 45.0,
      35.26438968275465}}};

/// Sets the angles of a view to a preset. Returns true if they changed.
bool face(View& view, const Preset& preset);

/// Turns a view of spheres by a drag of the mouse, in window units: the front follows the mouse.
/// Azimuths stay within -180..180 and elevations within -90..90. Returns true if the angles
/// changed.
bool turn(View& view, float right, float down);

}  // namespace clatter
