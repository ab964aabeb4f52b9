#include "engine/initial/random_insertion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/dynamics/cell_grid.h"

namespace clatter {

namespace {

// The room cut into cells that hold one centre at most, for their diagonal is one diameter at most,
// and the open voxels: parts of cells in which a centre may still find room. Tries go to open
// voxels only; after as many tries as there are voxels, each is split into four and those that one
// particle covers are dropped, so that tries keep succeeding up to the density at which the process
// jams.
class Insertion {
 public:
  explicit Insertion(const Room& room) : room_(room) {
    for (int axis = 0; axis < 2; ++axis) {
      low_[axis] = room.periodic[axis] ? 0.0 : 0.5 * room.diameter;
      const double extent = room.box[axis] - 2.0 * low_[axis];
      const double count = std::ceil(extent / room.diameter * std::sqrt(2.0));
      counts_[axis] = std::max(1, static_cast<int>(count));
      widths_[axis] = extent / counts_[axis];
    }
    centres_.resize(static_cast<std::size_t>(counts_[0]) * counts_[1], kEmpty);
    open_.reserve(centres_.size());
    for (int y = 0; y < counts_[1]; ++y) {
      for (int x = 0; x < counts_[0]; ++x) open_.push_back({x, y});
    }
  }

  // Places particles until there are `count`, or no voxel is open or can be split any more.
  void place(std::size_t count, Random& random) {
    placed_.reserve(count);
    for (int level = 0; level < kLevels && !open_.empty(); ++level) {
      const std::size_t tries = open_.size();
      for (std::size_t k = 0; k < tries; ++k) {
        if (placed_.size() == count) return;
        try_once(open_[random.below(open_.size())], random);
      }
      split_voxels();
    }
  }

  // Places a particle at a point, where there is room; before any of the others.
  bool place_first(const Vec2& point) {
    Voxel voxel;
    for (int axis = 0; axis < 2; ++axis) {
      const double place = std::floor((point[axis] - low_[axis]) / widths_[axis]);
      if (!(place >= 0.0 && place < counts_[axis])) return false;
      voxel[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(place);
    }
    return place_at(point, voxel);
  }

  std::vector<Vec2>& placed() { return placed_; }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;
  static constexpr int kLevels = 12;
  using Voxel = std::array<std::int32_t, 2>;  // its number along each axis at the present level

  void try_once(const Voxel& voxel, Random& random) {
    Vec2 point;
    for (int axis = 0; axis < 2; ++axis) {
      point[axis] = low_[axis] + (voxel[axis] + random.uniform()) * widths_[axis];
    }
    place_at(point, voxel);
  }

  bool place_at(const Vec2& point, const Voxel& voxel) {
    if (any_particle_within(voxel,
                            [&](const Vec2& centre) { return (centre - point).cwiseAbs(); })) {
      return false;
    }
    centres_[cell_of(voxel)] = static_cast<std::uint32_t>(placed_.size());
    placed_.push_back(point);
    return true;
  }

  void split_voxels() {
    ++level_;
    for (double& width : widths_) width *= 0.5;
    std::vector<Voxel> split;
    for (const Voxel& parent : open_) {
      for (int child = 0; child < 4; ++child) {
        const Voxel voxel = {2 * parent[0] + child % 2, 2 * parent[1] + child / 2};
        const Vec2 half(0.5 * widths_[0], 0.5 * widths_[1]);
        const Vec2 middle(low_[0] + (voxel[0] + 0.5) * widths_[0],
                          low_[1] + (voxel[1] + 0.5) * widths_[1]);
        // The corner that is farthest from a centre says whether that particle covers the voxel.
        const auto farthest = [&](const Vec2& centre) {
          return Vec2((centre - middle).cwiseAbs() + half);
        };
        if (!any_particle_within(voxel, farthest)) split.push_back(voxel);
      }
    }
    open_ = std::move(split);
  }

  // Whether a particle about the voxel lies less than a diameter off, by the given offset of its
  // centre.
  template <typename Offset>
  bool any_particle_within(const Voxel& voxel, const Offset& offset) const {
    const double closest = room_.diameter * room_.diameter;
    if (centres_[cell_of(voxel)] != kEmpty) return true;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        Vec2 wrap = Vec2::Zero();
        const int x = wrapped((voxel[0] >> level_) + dx, 0, wrap);
        const int y = wrapped((voxel[1] >> level_) + dy, 1, wrap);
        if (x < 0 || y < 0) continue;
        const std::uint32_t particle = centres_[static_cast<std::size_t>(y) * counts_[0] + x];
        if (particle != kEmpty && offset(placed_[particle] + wrap).squaredNorm() < closest)
          return true;
      }
    }
    return false;
  }

  std::size_t cell_of(const Voxel& voxel) const {
    return static_cast<std::size_t>(voxel[1] >> level_) * counts_[0] +
           static_cast<std::size_t>(voxel[0] >> level_);
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
  double widths_[2];  // of a voxel
  int level_ = 0;     // voxels are 2^-level_ of a cell
  std::vector<Vec2> placed_;
  std::vector<std::uint32_t> centres_;  // particle in each cell, or kEmpty
  std::vector<Voxel> open_;
};

// The same for a few particles in a large room, where almost every try succeeds: memory follows the
// particles and not the room.
class SparseInsertion {
 public:
  SparseInsertion(const Room& room, std::size_t count)
      : model_(empty(room)), grid_(model_, static_cast<double>(count)) {
    placed_.reserve(count);
  }

  void place(std::size_t count, Random& random) {
    while (placed_.size() < count) {
      Vec2 point;
      for (int axis = 0; axis < 2; ++axis) {
        point[axis] = low(axis) + random.uniform() * (model_.box[axis] - 2.0 * low(axis));
      }
      place_at(point);
    }
  }

  bool place_first(const Vec2& point) {
    for (int axis = 0; axis < 2; ++axis) {
      if (!(point[axis] >= low(axis) && point[axis] < model_.box[axis] - low(axis))) return false;
    }
    return place_at(point);
  }

  std::vector<Vec2>& placed() { return placed_; }

 private:
  static Model<2> empty(const Room& room) {
    Model<2> model;
    model.box = room.box;
    model.diameter = room.diameter;
    for (int side = 0; side < 4; ++side) {
      if (!room.periodic[side / 2]) model.walls[side] = Wall{};
    }
    return model;
  }

  double low(int axis) const { return model_.periodic(axis) ? 0.0 : model_.wall_plane(axis, 0); }

  bool place_at(const Vec2& point) {
    bool overlaps = false;
    grid_.visit(grid_.cell_at(point), [&](std::uint32_t other, const Vec2& wrap) {
      const Vec2 x = placed_[other] - point + wrap.cwiseProduct(model_.box);
      overlaps = overlaps || x.norm() < model_.diameter;
    });
    if (overlaps) return false;
    grid_.insert(static_cast<std::uint32_t>(placed_.size()), grid_.cell_at(point));
    placed_.push_back(point);
    return true;
  }

  Model<2> model_;
  CellGrid<2> grid_;
  std::vector<Vec2> placed_;
};

// As many of `wanted` as fit, then random places; empty where there is none for one.
template <class Places>
std::vector<Vec2> filled(Places places, int count, Random& random, const std::vector<Vec2>& wanted,
                         std::vector<std::size_t>& kept) {
  for (std::size_t i = 0; i < wanted.size() && static_cast<int>(kept.size()) < count; ++i) {
    if (places.place_first(wanted[i])) kept.push_back(i);
  }
  places.place(static_cast<std::size_t>(count), random);
  if (static_cast<int>(places.placed().size()) < count) return {};
  return std::move(places.placed());
}

}  // namespace

std::vector<Vec2> random_insertion(const Room& room, int count, Random& random) {
  std::vector<std::size_t> none;
  return random_insertion(room, count, random, {}, none);
}

std::vector<Vec2> random_insertion(const Room& room, int count, Random& random,
                                   const std::vector<Vec2>& wanted,
                                   std::vector<std::size_t>& kept) {
  constexpr double kSparse = 50.0;  // squares of the diameter per particle: phi below 0.016
  if (room.box.prod() > kSparse * room.diameter * room.diameter * count) {
    const auto places = static_cast<std::size_t>(count);
    return filled(SparseInsertion(room, places), count, random, wanted, kept);
  }
  return filled(Insertion(room), count, random, wanted, kept);
}

}  // namespace clatter
