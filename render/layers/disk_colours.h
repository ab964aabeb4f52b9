#pragma once

#include <array>
#include <cstdint>

#include "engine/publish/snapshot.h"
#include "render/layers/light_layer.h"
#include "render/palette.h"

namespace clatter {

/// A linear colour and an opacity, of 65535.
using Light = std::array<std::uint16_t, 4>;

/// The light that a colour stands for.
Light light_of(Colour colour);

/// The value of disk `i` that its colour shows; 0 where it shows nothing.
double disk_value(const Snapshot& snapshot, ColourBy colour_by, std::size_t i);

/// Which colours disks have.
struct DiskColours {
  ColourBy colour_by = ColourBy::None;
  ColourScale scale;  ///< from the value that it shows
  Colour plain;       ///< where it shows nothing
  Blending blending = Blending::Light;

  /// That of disk `i`.
  Colour of(const Snapshot& snapshot, std::size_t i) const;
};

}  // namespace clatter
