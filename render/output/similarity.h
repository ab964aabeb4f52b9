#pragma once

#include "render/output/image.h"

namespace clatter {

/// Structural similarity of two pictures of one size (Wang, Bovik, Sheikh & Simoncelli 2004): that
/// of their luma in squares of 8 x 8 pixels, 4 apart, averaged. 1: equal.
double structural_similarity(const Image& a, const Image& b);

/// A picture at another size, linear between its pixels.
Image resized(const Image& image, Size size);

}  // namespace clatter
