#pragma once

#include "render/output/image.h"

namespace clatter {

/// Structural similarity index of two pictures of equal size (Wang, Bovik, Sheikh & Simoncelli
/// 2004); 1: equal. It is the mean over the luma of squares of 8 x 8 pixels, 4 pixels apart.
double structural_similarity(const Image& a, const Image& b);

/// A picture resampled to another size with bilinear interpolation.
Image resized(const Image& image, Size size);

}  // namespace clatter
