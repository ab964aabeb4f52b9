#include "render/output/similarity.h"

#include <algorithm>
#include <cmath>

namespace clatter {

static double luma(const Image& image, int x, int y) {
  const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.width) +
                       static_cast<std::size_t>(x));
  return 0.299 * image.rgba[at] + 0.587 * image.rgba[at + 1] + 0.114 * image.rgba[at + 2];
}

double structural_similarity(const Image& a, const Image& b) {
  constexpr int kSquare = 8, kStride = 4;
  constexpr double kMean = 0.01 * 255.0 * 0.01 * 255.0, kVariance = 0.03 * 255.0 * 0.03 * 255.0;
  constexpr double kPixels = kSquare * kSquare;
  double sum = 0.0;
  int squares = 0;
  for (int top = 0; top + kSquare <= a.size.height; top += kStride) {
    for (int left = 0; left + kSquare <= a.size.width; left += kStride) {
      double sum_a = 0.0, sum_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
      for (int k = 0; k < kSquare * kSquare; ++k) {
        const int x = left + k % kSquare, y = top + k / kSquare;
        const double of_a = luma(a, x, y), of_b = luma(b, x, y);
        sum_a += of_a;
        sum_b += of_b;
        aa += of_a * of_a;
        bb += of_b * of_b;
        ab += of_a * of_b;
      }
      const double mean_a = sum_a / kPixels, mean_b = sum_b / kPixels;
      const double means = mean_a * mean_a + mean_b * mean_b, product = mean_a * mean_b;
      sum += (2.0 * product + kMean) * (2.0 * (ab / kPixels - product) + kVariance) /
             ((means + kMean) * ((aa + bb) / kPixels - means + kVariance));
      ++squares;
    }
  }
  return squares > 0 ? sum / squares : 1.0;
}

Image resized(const Image& image, Size size) {
  Image result{size, {}};
  result.rgba.reserve(4 * static_cast<std::size_t>(size.width) *
                      static_cast<std::size_t>(size.height));
  const auto channel = [&](int x, int y, int c) {
    const int column = std::clamp(x, 0, image.size.width - 1);
    const int row = std::clamp(y, 0, image.size.height - 1);
    return static_cast<double>(
        image.rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.size.width) +
                        static_cast<std::size_t>(column)) +
                   static_cast<std::size_t>(c)]);
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double at_x = (x + 0.5) * image.size.width / size.width - 0.5;
      const double at_y = (y + 0.5) * image.size.height / size.height - 0.5;
      const int left = static_cast<int>(std::floor(at_x)), top = static_cast<int>(std::floor(at_y));
      const double right_share = at_x - left, lower_share = at_y - top;
      for (int c = 0; c < 4; ++c) {
        const double upper =
            std::lerp(channel(left, top, c), channel(left + 1, top, c), right_share);
        const double lower =
            std::lerp(channel(left, top + 1, c), channel(left + 1, top + 1, c), right_share);
        result.rgba.push_back(
            static_cast<unsigned char>(std::lround(std::lerp(upper, lower, lower_share))));
      }
    }
  }
  return result;
}

}  // namespace clatter
