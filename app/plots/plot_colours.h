#pragma once

#include <array>

#include "render/palette.h"

namespace clatter {

// Colours of curves for colour-blind readers (Okabe and Ito 2008).
inline constexpr Colour kBlue = {0x56, 0xb4, 0xe9}, kOrange = {0xe6, 0x9f, 0x00},
                        kGreen = {0x00, 0x9e, 0x73}, kRed = {0xd5, 0x5e, 0x00},
                        kPurple = {0xcc, 0x79, 0xa7}, kYellow = {0xcf, 0xc0, 0x2a};

/// Colours of the curves along x, y and z.
inline constexpr std::array<Colour, 3> kAxisColours = {kOrange, kBlue, kYellow};

}  // namespace clatter
