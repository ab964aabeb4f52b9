#include "render/plane_map.h"

#include <cmath>
#include <cstddef>

namespace clatter {

// One pass of the weights (1 2 1)/4 along `count` cells that are `stride` apart.
static void mix_neighbours(double* cells, std::size_t count, std::size_t stride, bool periodic) {
  const double first = cells[0], last = cells[(count - 1) * stride];
  double before = periodic ? last : first;
  for (std::size_t i = 0; i < count; ++i) {
    const double here = cells[i * stride];
    const double after = i + 1 < count ? cells[(i + 1) * stride] : periodic ? first : last;
    cells[i * stride] = 0.25 * (before + after) + 0.5 * here;
    before = here;
  }
}

static void mix_neighbours(const PlaneMap& map, std::vector<double>& cells) {
  constexpr int kPasses = 2;
  const auto width = static_cast<std::size_t>(map.width);
  const auto height = static_cast<std::size_t>(map.height);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t row = 0; row < height; ++row) {
      mix_neighbours(&cells[row * width], width, 1, map.periodic[0]);
    }
    for (std::size_t column = 0; column < width; ++column) {
      mix_neighbours(&cells[column], height, width, map.periodic[1]);
    }
  }
}

SmoothMap smoothed(const PlaneMap& map) {
  SmoothMap smooth{map.values, std::vector<double>(map.values.size(), 1.0)};
  bool gaps = false;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (!std::isnan(map.values[i])) continue;
    gaps = true;
    smooth.values[i] = smooth.shares[i] = 0.0;
  }
  mix_neighbours(map, smooth.values);
  if (!gaps) return smooth;
  mix_neighbours(map, smooth.shares);
  for (std::size_t i = 0; i < map.values.size(); ++i) smooth.values[i] /= smooth.shares[i];
  return smooth;
}

}  // namespace clatter
