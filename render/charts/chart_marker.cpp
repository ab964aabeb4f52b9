#include "render/charts/chart_marker.h"

#include <array>
#include <cmath>
#include <numbers>

#include "render/charts/chart_layout.h"

namespace clatter {

// Okabe and Ito (2008), with the colours that are palest on white last.
static constexpr std::array<Colour, 8> kSeriesColours = {{{0x00, 0x72, 0xb2},    // blue
                                                          {0xd5, 0x5e, 0x00},    // vermilion
                                                          {0x00, 0x9e, 0x73},    // bluish green
                                                          {0xe6, 0x9f, 0x00},    // orange
                                                          {0xcc, 0x79, 0xa7},    // reddish purple
                                                          {0x56, 0xb4, 0xe9},    // sky blue
                                                          {0x00, 0x00, 0x00},    // black
                                                          {0xf0, 0xe4, 0x42}}};  // yellow

Colour series_ink(std::size_t series) {
  // Darker than the markers, because thin lines in pale colours are hard to see.
  return mix(kSeriesColours[series % kSeriesColours.size()], kChartInk, 0.2);
}

Colour marker_fill(std::size_t series) {
  const bool hollow = series / kSeriesColours.size() % 2 == 1;
  return hollow ? kChartPaper : kSeriesColours[series % kSeriesColours.size()];
}

std::vector<Vec2> marker_corners(std::size_t series, Vec2 centre, double radius) {
  std::vector<Vec2> corners;
  const auto add = [&](double degrees, double size) {
    const double angle = degrees * std::numbers::pi / 180.0;
    corners.emplace_back(centre + size * radius * Vec2(std::sin(angle), -std::cos(angle)));
  };
  const auto regular = [&](int count, double first, double size) {
    for (int k = 0; k < count; ++k) add(first + 360.0 * k / count, size);
  };
  // Arms of a plus sign, turned by `first`.
  const auto cross = [&](double first) {
    for (int arm = 0; arm < 4; ++arm) {
      for (const double side : {-20.0, 20.0}) add(first + 90.0 * arm + side, 1.4);
      add(first + 90.0 * arm + 45.0, 1.4 * std::numbers::sqrt2 * std::sin(std::numbers::pi / 9.0));
    }
  };
  switch ((series + series / (2 * kSeriesColours.size())) % 8) {
    case 0:
      break;
    case 1:
      regular(4, 45.0, 1.28);
      break;
    case 2:
      regular(3, 0.0, 1.45);
      break;
    case 3:
      regular(4, 0.0, 1.4);
      break;
    case 4:
      regular(3, 60.0, 1.45);
      break;
    case 5:
      cross(0.0);
      break;
    case 6:
      for (int point = 0; point < 5; ++point) {
        add(72.0 * point, 1.5);
        add(72.0 * point + 36.0, 0.66);
      }
      break;
    default:
      cross(45.0);
  }
  return corners;
}

}  // namespace clatter
