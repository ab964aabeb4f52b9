#pragma once

#include <cstdint>

namespace clatter {

/// A near particle and its periodic image. The low bits are the particle's number. Two bits per
/// axis above give its wrap: the box lengths -1, 0 or +1 across the periodic border.
using Neighbour = std::uint32_t;

/// An empty entry of a list of neighbours.
inline constexpr Neighbour kNobody = ~Neighbour{0};

/// Number of bits of the particle's number.
template <int D>
inline constexpr int kParticleBits = 32 - 2 * D;

/// The particle's number.
template <int D>
std::uint32_t particle_of(Neighbour neighbour) {
  return neighbour & ((Neighbour{1} << kParticleBits<D>)-1);
}

/// Number of bits above those of the wrap along an axis.
template <int D>
constexpr int bits_above(int axis) {
  return 2 * (D - 1 - axis);
}

/// The wrap along an axis.
template <int D>
int wrap_of(Neighbour neighbour, int axis) {
  // Two bits with their sign.
  return static_cast<std::int32_t>(neighbour << bits_above<D>(axis)) >> 30;
}

}  // namespace clatter
