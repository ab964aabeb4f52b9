#include "engine/initial/random_insertion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <utility>

#include "engine/dynamics/near_particles.h"

namespace clatter {

template <int D>
struct RandomInsertion<D>::Work {
  virtual ~Work() = default;
  // As place_first().
  virtual bool place_first(const Vec<D>& point) = 0;
  // As advance().
  virtual bool place(std::size_t count, Random& random, const StopRequest& pause) = 0;
  virtual std::size_t placed() const = 0;
  // The centres. None remain.
  virtual std::vector<Vec<D>> take() = 0;
};

namespace {

// Random insertion with voxels. The room is cut into cells with a diagonal of at most one diameter,
// so that each holds at most one centre. Open voxels are the parts of cells that may still have
// room for a centre; tries use only these. After as many tries as there are voxels, each voxel is
// split into 2^D, and those that one particle covers are dropped. So tries continue to succeed up
// to the jamming density.
template <int D>
class Insertion : public RandomInsertion<D>::Work {
 public:
  Insertion(const Room<D>& room, const FixtureImages<D>& fixtures)
      : room_(room), fixtures_(fixtures) {
    std::size_t cells = 1;
    for (int axis = 0; axis < D; ++axis) {
      low_[axis] = room.walled[axis] ? 0.5 * room.diameter : 0.0;
      const double extent = room.box[axis] - 2.0 * low_[axis];
      const double count =
          std::max(1.0, std::ceil(extent / room.diameter * std::sqrt(static_cast<double>(D))));
      counts_[axis] = static_cast<int>(count);
      widths_[axis] = extent / counts_[axis];
      const double reach = std::ceil(room.diameter / widths_[axis]);
      reach_[axis] = static_cast<int>(std::min(reach, count));
      cells *= static_cast<std::size_t>(counts_[axis]);
    }
    centres_.resize(cells, kEmpty);
    collect(
        Voxel::Zero(), counts_ - Voxel::Ones(), [](const Voxel&) { return false; }, open_);
    tries_left_ = open_.size();
  }

  // Places particles until there are `count`, no voxel is open, or voxels cannot be split further.
  // Returns false at a request to pause.
  bool place(std::size_t count, Random& random, const StopRequest& pause) override {
    placed_.reserve(count);
    while (level_ < kLevels && !open_.empty()) {
      for (; tries_left_ > 0; --tries_left_) {
        if (placed_.size() == count) return true;
        if (tries_left_ % kStepsPerQuestion == 0 && pause.made()) return false;
        try_once(open_[random.below(open_.size())], random);
      }
      if (!split_voxels(pause)) return false;
    }
    return true;
  }

  // Places a particle at a point if there is room. To be called before place().
  bool place_first(const Vec<D>& point) override {
    Voxel voxel;
    for (int axis = 0; axis < D; ++axis) {
      const double place = std::floor((point[axis] - low_[axis]) / widths_[axis]);
      if (!(place >= 0.0 && place < counts_[axis])) return false;
      voxel[axis] = static_cast<int>(place);
    }
    return place_at(point, voxel);
  }

  std::size_t placed() const override { return placed_.size(); }
  std::vector<Vec<D>> take() override { return std::move(placed_); }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;
  static constexpr int kLevels = 12;
  using Voxel = IntVec<D>;  // number along each axis, at the current level

  // Whether is(voxel) holds for any voxel from `first` to `last`, x fastest.
  template <typename Predicate>
  static bool any_of(const Voxel& first, const Voxel& last, const Predicate& is) {
    Voxel at = first;
    while (at[D - 1] <= last[D - 1]) {
      if (is(at)) return true;
      for (int k = 0; ++at[k] > last[k] && k < D - 1; ++k) at[k] = first[k];
    }
    return false;
  }

  // Appends to `open` the voxels from `first` to `last` for which covers(voxel) is false.
  template <typename Predicate>
  static void collect(const Voxel& first, const Voxel& last, const Predicate& covers,
                      std::deque<Voxel>& open) {
    any_of(first, last, [&](const Voxel& voxel) {
      if (!covers(voxel)) open.push_back(voxel);
      return false;
    });
  }

  void try_once(const Voxel& voxel, Random& random) {
    Vec<D> point;
    for (int axis = 0; axis < D; ++axis) {
      point[axis] = low_[axis] + (voxel[axis] + random.uniform()) * widths_[axis];
    }
    place_at(point, voxel);
  }

  bool place_at(const Vec<D>& point, const Voxel& voxel) {
    const auto offset = [&](const Vec<D>& centre) -> Vec<D> { return (centre - point).cwiseAbs(); };
    if (any_particle_within(voxel, offset)) return false;
    if (fixtures_.depth(point, 0.5 * room_.diameter, kSeesAll) > 0.0) return false;
    centres_[cell_of(voxel)] = static_cast<std::uint32_t>(placed_.size());
    placed_.push_back(point);
    return true;
  }

  // Returns false at a request to pause.
  bool split_voxels(const StopRequest& pause) {
    if (!std::exchange(splits_, true)) {
      ++level_;
      widths_ *= 0.5;
    }
    const auto is_covered = [&](const Voxel& voxel) {
      const Vec<D> half = 0.5 * widths_;
      Vec<D> middle;
      for (int k = 0; k < D; ++k) middle[k] = low_[k] + (voxel[k] + 0.5) * widths_[k];
      // A particle covers the voxel if it covers the corner farthest from its centre. So does a
      // fixture if it is deeper at the middle than the corners are away.
      if (fixtures_.depth(middle, 0.5 * room_.diameter, kSeesAll) > half.norm()) return true;
      return any_particle_within(voxel, [&](const Vec<D>& centre) -> Vec<D> {
        return (centre - middle).cwiseAbs() + half;
      });
    };
    for (; !open_.empty(); open_.pop_front()) {
      if (open_.size() % kStepsPerQuestion == 0 && pause.made()) return false;
      const Voxel parent = 2 * open_.front();
      collect(parent, parent + Voxel::Ones(), is_covered, split_);
    }
    open_ = std::exchange(split_, {});
    tries_left_ = open_.size();
    splits_ = false;
    return true;
  }

  // Whether a particle near the voxel is closer than a diameter, by the given offset of its centre.
  template <typename Offset>
  bool any_particle_within(const Voxel& voxel, const Offset& offset) const {
    const double closest = room_.diameter * room_.diameter;
    if (centres_[cell_of(voxel)] != kEmpty) return true;
    Voxel own;
    for (int k = 0; k < D; ++k) own[k] = voxel[k] >> level_;
    return any_of(own - reach_, own + reach_, [&](Voxel cell) {
      Vec<D> wrap = Vec<D>::Zero();
      if (!wrap_into_room(cell, wrap)) return false;
      const std::uint32_t particle = centres_[index(cell)];
      return particle != kEmpty && offset(placed_[particle] + wrap).squaredNorm() < closest;
    });
  }

  std::size_t index(const IntVec<D>& cell) const {
    std::size_t number = 0;
    for (int k = D - 1; k >= 0; --k) {
      number = number * static_cast<std::size_t>(counts_[k]) + static_cast<std::size_t>(cell[k]);
    }
    return number;
  }

  std::size_t cell_of(const Voxel& voxel) const {
    IntVec<D> cell;
    for (int k = 0; k < D; ++k) cell[k] = voxel[k] >> level_;
    return index(cell);
  }

  // Maps a cell to its periodic image in the room and sets `wrap` to the displacement. Returns
  // false beyond a wall.
  bool wrap_into_room(IntVec<D>& cell, Vec<D>& wrap) const {
    for (int k = 0; k < D; ++k) {
      const int count = counts_[k];
      if (cell[k] >= 0 && cell[k] < count) continue;
      if (room_.walled[k]) return false;
      const int boxes = cell[k] < 0 ? -((count - 1 - cell[k]) / count) : cell[k] / count;
      wrap[k] = boxes * room_.box[k];
      cell[k] -= boxes * count;
    }
    return true;
  }

  Room<D> room_;
  FixtureImages<D> fixtures_;
  Vec<D> low_;
  IntVec<D> counts_;
  IntVec<D> reach_;  // number of cells on either side within a diameter
  Vec<D> widths_;    // of a voxel
  int level_ = 0;    // voxels are 2^-level_ of a cell
  std::vector<Vec<D>> placed_;
  std::vector<std::uint32_t> centres_;  // particle in each cell, or kEmpty
  std::deque<Voxel> open_;              // releases its memory from the front as voxels are split
  std::deque<Voxel> split_;             // open parts of the voxels that have been split
  bool splits_ = false;                 // some voxels of open_ have been split
  std::size_t tries_left_ = 0;          // before the next splitting
};

// Random insertion for few particles in a large room, where almost every try succeeds. Memory grows
// with the particles, not with the room.
template <int D>
class SparseInsertion : public RandomInsertion<D>::Work {
 public:
  SparseInsertion(const Room<D>& room, const FixtureImages<D>& fixtures)
      : room_(room), fixtures_(fixtures), near_(domain_of(room), room.diameter) {}

  bool place(std::size_t count, Random& random, const StopRequest& pause) override {
    while (placed() < count && failures_ < kMostFailures) {
      const std::size_t steps = placed() + static_cast<std::size_t>(failures_);
      if (steps % kStepsPerQuestion == 0 && pause.made()) return false;
      Vec<D> point;
      for (int axis = 0; axis < D; ++axis) {
        point[axis] = low(axis) + random.uniform() * (room_.box[axis] - 2.0 * low(axis));
      }
      failures_ = place_at(point) || !fixtures_.any() ? 0 : failures_ + 1;
    }
    return true;
  }

  bool place_first(const Vec<D>& point) override {
    for (int axis = 0; axis < D; ++axis) {
      if (!(point[axis] >= low(axis) && point[axis] < room_.box[axis] - low(axis))) return false;
    }
    return place_at(point);
  }

  std::size_t placed() const override { return near_.positions().size(); }
  std::vector<Vec<D>> take() override { return near_.take(); }

 private:
  static Domain<D> domain_of(const Room<D>& room) {
    Domain<D> domain{.box = room.box};
    for (int axis = 0; axis < D; ++axis) domain.periodic[axis] = !room.walled[axis];
    return domain;
  }

  double low(int axis) const { return room_.walled[axis] ? 0.5 * room_.diameter : 0.0; }

  bool place_at(const Vec<D>& point) {
    if (fixtures_.depth(point, 0.5 * room_.diameter, kSeesAll) > 0.0) return false;
    if (near_.any_within(point, room_.diameter)) return false;
    near_.add(point);
    return true;
  }

  // Tries in succession after which fixtures fill the room.
  static constexpr int kMostFailures = 1'000'000;

  Room<D> room_;
  FixtureImages<D> fixtures_;
  NearParticles<D> near_;
  int failures_ = 0;  // tries since the last particle
};

template <int D>
std::unique_ptr<typename RandomInsertion<D>::Work> work_in(const Room<D>& room, std::size_t count,
                                                           const FixtureImages<D>& fixtures) {
  constexpr double kSparse = 50.0;  // room per particle, in cubed (2D: squared) diameters
  const double cube =
      D == 2 ? room.diameter * room.diameter : room.diameter * room.diameter * room.diameter;
  if (room.box.prod() > kSparse * cube * static_cast<double>(count)) {
    return std::make_unique<SparseInsertion<D>>(room, fixtures);
  }
  return std::make_unique<Insertion<D>>(room, fixtures);
}

}  // namespace

template <int D>
RandomInsertion<D>::RandomInsertion(const Room<D>& room, int count, Random& random,
                                    const FixtureImages<D>& fixtures)
    : count_(static_cast<std::size_t>(count)),
      random_(random),
      work_(work_in(room, count_, fixtures)) {}

template <int D>
RandomInsertion<D>::~RandomInsertion() = default;

template <int D>
bool RandomInsertion<D>::place_first(const Vec<D>& point) {
  return work_->place_first(point);
}

template <int D>
bool RandomInsertion<D>::advance(const StopRequest& pause) {
  return work_->place(count_, random_, pause);
}

template <int D>
std::size_t RandomInsertion<D>::placed() const {
  return work_->placed();
}

template <int D>
std::vector<Vec<D>> RandomInsertion<D>::take() {
  if (placed() < count_) return {};
  return work_->take();
}

template <int D>
std::vector<Vec<D>> random_insertion(const Room<D>& room, int count, Random& random) {
  RandomInsertion<D> insertion(room, count, random);
  insertion.advance();
  return insertion.take();
}

template class RandomInsertion<2>;
template class RandomInsertion<3>;
template std::vector<Vec<2>> random_insertion(const Room<2>&, int, Random&);
template std::vector<Vec<3>> random_insertion(const Room<3>&, int, Random&);

}  // namespace clatter
