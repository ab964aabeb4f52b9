#include "engine/dynamics/random_insertion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace clatter {

namespace {

// The room cut into cells that hold one centre at most: their diagonal is one diameter at most.
class Insertion {
 public:
  explicit Insertion(const Room& room) : room_(room) {
    for (int axis = 0; axis < 2; ++axis) {
      low_[axis] = room.periodic[axis] ? 0.0 : 0.5 * room.diameter;
      const double extent = room.box[axis] - 2.0 * low_[axis];
      counts_[axis] = std::max(1, static_cast<int>(std::ceil(extent / room.diameter * std::sqrt(2.0))));
      widths_[axis] = extent / counts_[axis];
    }
    centres_.resize(static_cast<std::size_t>(counts_[0]) * counts_[1], kEmpty);
    open_.resize(centres_.size());
    for (std::size_t cell = 0; cell < open_.size(); ++cell) open_[cell] = static_cast<std::uint32_t>(cell);
  }

  // Tries one place in a random open cell; cells in which no place is left are closed for good.
  bool try_once(std::vector<Vec2>& placed, Random& random) {
    const std::size_t pick = random.below(open_.size());
    const std::uint32_t cell = open_[pick];
    const int column = static_cast<int>(cell % counts_[0]);
    const int row = static_cast<int>(cell / counts_[0]);
    const Vec2 corner = {low_[0] + column * widths_[0], low_[1] + row * widths_[1]};
    const Vec2 place = corner + Vec2(random.uniform() * widths_[0], random.uniform() * widths_[1]);
    const Blocked blocked = look(placed, column, row, corner, place);
    if (!blocked.place) {
      centres_[cell] = static_cast<std::uint32_t>(placed.size());
      placed.push_back(place);
    }
    if (!blocked.place || blocked.cell) {
      open_[pick] = open_.back();
      open_.pop_back();
    }
    return !blocked.place;
  }

  bool full() const { return open_.empty(); }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;
  struct Blocked {
    bool place = false;  // the place overlaps a disk
    bool cell = false;   // one disk leaves no place in the whole cell
  };

  Blocked look(const std::vector<Vec2>& placed, int column, int row, const Vec2& corner,
               const Vec2& place) const {
    const double closest = room_.diameter * room_.diameter;
    Blocked blocked;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        Vec2 wrap = Vec2::Zero();
        const int x = wrapped(column + dx, 0, wrap);
        const int y = wrapped(row + dy, 1, wrap);
        if (x < 0 || y < 0) continue;
        const std::uint32_t disk = centres_[static_cast<std::size_t>(y) * counts_[0] + x];
        if (disk == kEmpty) continue;
        const Vec2 centre = placed[disk] + wrap;
        blocked.place = blocked.place || (centre - place).squaredNorm() < closest;
        const Vec2 low = (centre - corner).cwiseAbs();
        const Vec2 high = (centre - corner - Vec2(widths_[0], widths_[1])).cwiseAbs();
        blocked.cell = blocked.cell || low.cwiseMax(high).squaredNorm() < closest;
      }
    }
    return blocked;
  }

  // The cell number in range, its box lengths added to `wrap`; -1 beyond a wall.
  int wrapped(int number, int axis, Vec2& wrap) const {
    const int count = counts_[axis];
    if (number >= 0 && number < count) return number;
    if (!room_.periodic[axis]) return -1;
    const int boxes = number < 0 ? -((count - 1 - number) / count) : number / count;
    wrap[axis] = boxes * room_.box[axis];
    return number - boxes * count;
  }

  Room room_;
  double low_[2];
  int counts_[2];
  double widths_[2];
  std::vector<std::uint32_t> centres_;  // disk in each cell, or kEmpty
  std::vector<std::uint32_t> open_;     // cells that may still have room
};

}  // namespace

std::vector<Vec2> random_insertion(const Room& room, int count, Random& random) {
  constexpr int kTriesPerDisk = 10000;
  std::vector<Vec2> placed;
  placed.reserve(static_cast<std::size_t>(count));
  Insertion insertion(room);
  int tries = 0;
  while (static_cast<int>(placed.size()) < count) {
    if (insertion.full() || ++tries > kTriesPerDisk) return {};
    if (insertion.try_once(placed, random)) tries = 0;
  }
  return placed;
}

}  // namespace clatter
