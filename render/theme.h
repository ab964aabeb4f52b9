#pragma once

#include "render/palette.h"

namespace clatter {

/// The dark theme: what every layer takes its colours from.
namespace theme {

inline constexpr Colour kBackground = {0x10, 0x14, 0x18};
inline constexpr Colour kText = {0xe6, 0xea, 0xee};
inline constexpr Colour kFaintText = {0x8c, 0x96, 0xa0};
inline constexpr Colour kDisk = {0xb4, 0xc0, 0xcc};             ///< where the colour shows nothing
inline constexpr Colour kStaticWall = {0x78, 0x82, 0x8c};       ///< also of the periodic border
inline constexpr Colour kWallPlace = {0x78, 0x82, 0x8c, 0x60};  ///< about which a wall moves
inline constexpr Colour kDrivenWall = {0xf2, 0xa6, 0x3c};

}  // namespace theme

}  // namespace clatter
