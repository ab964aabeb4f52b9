#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/layers/light_layer.h"
#include "render/palette.h"

namespace clatter {

/// Linear red, green and blue, and opacity, each scaled to 0..65535.
using Light = std::array<std::uint16_t, 4>;

/// The linear light of an sRGB colour.
Light light_of(Colour colour);

/// The value that determines the colour of particle `i`; 0 for colours without a scale and without
/// spins.
/// The depth of spheres is their distance from the middle of the box along the direction `away`
/// from the viewer.
double disk_value(const Snapshot& snapshot, ColourBy colour_by, std::size_t i,
                  const VecX& away = {});

/// The colours of the disks.
struct DiskColours {
  ColourBy colour_by = ColourBy::None;
  ColourScale scale;  ///< colours of the values
  Colour plain;       ///< colour for ColourBy::None, and of particles without a species
  Blending blending = Blending::Light;
  VecX away = {};                          ///< of spheres: unit vector away from the viewer
  std::optional<std::size_t> tracer = {};  ///< number of the disk with the colour `traced`
  Colour traced = {};
  std::vector<Colour> species = {};  ///< colours for ColourBy::Species

  /// The colour of disk `i`.
  Colour of(const Snapshot& snapshot, std::size_t i) const;
};

}  // namespace clatter
