#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/vec.h"

namespace clatter {

/// A periodic image and the kind of a particle, in one word that contact kernels read. The low bits
/// are box lengths along each axis as signed fields of equal width, the first axis lowest. Above is
/// the kind, and the highest bit marks kFarImage.
using PackedImage = std::int32_t;

/// Stands for an image with a component that does not fit its field.
inline constexpr PackedImage kFarImage = std::numeric_limits<PackedImage>::min();

/// Number of bits of the image, of each of its components, and of the kind.
inline constexpr int kAllImageBits = 24, kKindBits = 31 - kAllImageBits;
template <int D>
inline constexpr int kImageBits = kAllImageBits / D;

/// The bits of the image.
inline constexpr PackedImage kImageMask = kFarImage | ((1 << kAllImageBits) - 1);

/// The kind of a particle, see GrainArray::kinds().
[[gnu::always_inline]] inline std::uint32_t kind_of(PackedImage word) {
  return static_cast<std::uint32_t>(word & ~kImageMask) >> kAllImageBits;
}

/// The word of an image, of kind 0.
template <int D>
PackedImage packed_image(const Vec<D>& image) {
  constexpr int kMax = (1 << (kImageBits<D> - 1)) - 1;
  if (!(image.cwiseAbs().maxCoeff() <= kMax)) return kFarImage;
  std::uint32_t word = 0;
  for (int axis = 0; axis < D; ++axis) {
    constexpr std::uint32_t kField = (std::uint32_t{1} << kImageBits<D>)-1;
    const auto component = static_cast<std::uint32_t>(static_cast<std::int32_t>(image[axis]));
    word |= (component & kField) << (kImageBits<D> * axis);
  }
  return static_cast<PackedImage>(word);
}

/// Component of an image, from its word or from a vector of words. Meaningless if it is far.
template <int D, class Word>
[[gnu::always_inline]] inline Word image_component(const Word& word, int axis) {
  return (word << (32 - kImageBits<D> * (axis + 1))) >> (32 - kImageBits<D>);
}

}  // namespace clatter
