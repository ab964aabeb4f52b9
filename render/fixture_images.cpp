#include "render/fixture_images.h"

#include <algorithm>
#include <cmath>

namespace clatter {

std::array<int, 2> image_shifts(const std::array<double, 2>& interval, double period, bool periodic,
                                const std::array<double, 2>& drawn) {
  const auto [low, high] = interval;
  if (!periodic) return low < drawn[1] && high > drawn[0] ? std::array{0, 0} : std::array{1, 0};
  return {static_cast<int>(std::floor((drawn[0] - high) / period)) + 1,
          static_cast<int>(std::ceil((drawn[1] - low) / period)) - 1};
}

std::vector<std::array<double, 2>> closed_parts(const std::array<double, 2>& interval,
                                                std::vector<std::array<double, 2>> openings) {
  std::ranges::sort(openings);
  openings.push_back({interval[1], interval[1]});
  std::vector<std::array<double, 2>> closed;
  double from = interval[0];
  for (const auto& [low, high] : openings) {
    if (low > from) closed.push_back({from, std::min(low, interval[1])});
    from = std::max(from, high);
    if (from >= interval[1]) break;
  }
  return closed;
}

std::vector<std::array<double, 2>> closed_segments(const Partition& partition,
                                                   const Snapshot& snapshot,
                                                   const std::array<double, 2>& drawn) {
  const int along = 1 - static_cast<int>(partition.axis);
  const bool periodic = !snapshot.walls[2 * along];
  const double period = snapshot.box[along];
  std::vector<std::array<double, 2>> openings;
  for (const Hole& hole : partition.holes) {
    const std::array<double, 2> opening = {hole.from[0], hole.to[0]};
    const auto [first, last] = image_shifts(opening, period, periodic, drawn);
    for (int shift = first; shift <= last; ++shift) {
      openings.push_back({opening[0] + shift * period, opening[1] + shift * period});
    }
  }
  return closed_parts(drawn, std::move(openings));
}

std::vector<PlatePart> closed_rectangles(const Partition& partition, const Snapshot& snapshot) {
  const int axis = static_cast<int>(partition.axis);
  const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
  std::vector<double> cuts = {0.0, snapshot.box[first]};
  for (const Hole& hole : partition.holes) {
    cuts.push_back(hole.from[0]);
    cuts.push_back(hole.to[0]);
  }
  std::ranges::sort(cuts);
  std::vector<PlatePart> parts;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double from = cuts[k], to = cuts[k + 1];
    if (!(from < to)) continue;
    std::vector<std::array<double, 2>> openings;
    for (const Hole& hole : partition.holes) {
      if (hole.from[0] <= from && hole.to[0] >= to) openings.push_back({hole.from[1], hole.to[1]});
    }
    for (const auto& [low, high] : closed_parts({0.0, snapshot.box[second]}, openings)) {
      parts.push_back({Vec2(from, low), Vec2(to, high)});
    }
  }
  return parts;
}

}  // namespace clatter
