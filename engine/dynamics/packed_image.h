#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/vec.h"

namespace clatter {

/// A periodic image in one word that contact kernels read: box lengths along each axis as signed
/// fields of equal width, the first axis lowest. The highest bit marks kFarImage.
using PackedImage = std::int32_t;

/// Stands for an image with a component that does not fit its field.
inline constexpr PackedImage kFarImage = std::numeric_limits<PackedImage>::min();

/// Number of bits of each component.
template <int D>
inline constexpr int kImageBits = 31 / D;

/// The word of an image.
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

/// Component of an image, from its word or from a vector of words. Meaningless for kFarImage.
template <int D, class Word>
[[gnu::always_inline]] inline Word image_component(const Word& word, int axis) {
  return (word << (32 - kImageBits<D> * (axis + 1))) >> (32 - kImageBits<D>);
}

}  // namespace clatter
