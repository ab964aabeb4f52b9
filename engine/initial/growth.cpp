#include "engine/initial/growth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/physics/elementary.h"
#include "engine/physics/theory.h"

namespace clatter {

static constexpr int kMostPasses = 1000;

// Packing fraction up to which insertion is fast.
template <int D>
static constexpr double kInsertedFraction = D == 2 ? 0.38 : 0.25;

template <int D>
Growth<D>::Growth(const Room<D>& room, int count, Random& random)
    : domain_{.box = room.box},
      count_(static_cast<std::size_t>(count)),
      random_(random),
      diameter_(room.diameter),
      low_(Vec<D>::Zero()),
      high_(room.box) {
  Vec<D> fit;  // cells
  for (int axis = 0; axis < D; ++axis) {
    domain_.periodic[axis] = !room.walled[axis];
    if (room.walled[axis]) {
      low_[axis] = 0.5 * diameter_;
      high_[axis] -= low_[axis];
    }
    constexpr double kWider = 1.01;  // than the diameter
    fit[axis] = std::max(1.0, std::floor((high_[axis] - low_[axis]) / (kWider * diameter_)));
  }
  // Of the room for centres: in a narrow room they are denser than the particles.
  constexpr double kDensest = 0.6, kNarrowest = 0.25;
  const Vec<D> extents = (high_ - low_).cwiseMax(kNarrowest * diameter_);
  const double cube = Vec<D>::Constant(diameter_).prod();
  const double fraction = std::min(kDensest, packing_fraction(D, count * cube / extents.prod()));
  // The scale of lengths that leads to another packing fraction, at most 2.
  const auto scale_to = [&](double other) {
    return exponential(std::min(natural_log(other / fraction) / D, natural_log(2.0)));
  };
  inserted_diameter_ = diameter_ * std::min(1.0, scale_to(kInsertedFraction<D>));
  // A share of the gaps in a lattice of this density. After one collision a particle, the pressure
  // is within 4 percent of that in equilibrium.
  const double gap_of_lattice = diameter_ * (scale_to(closest_packing(D)) - 1.0);
  most_gap_ = std::clamp(0.35 * gap_of_lattice, 0.0, 0.07 * diameter_);
  // The cells of a sparse gas are few.
  while (fit.prod() > 4.0 * count + 64.0) {
    int longest;
    fit.maxCoeff(&longest);
    fit[longest] = std::ceil(0.5 * fit[longest]);
  }
  for (int axis = 0; axis < D; ++axis) {
    const double extent = high_[axis] - low_[axis];
    counts_[axis] = static_cast<int>(fit[axis]);
    widths_[axis] = extent > 0.0 ? extent / counts_[axis] : diameter_;
    is_narrow_ = is_narrow_ || (domain_.periodic[axis] && counts_[axis] < 3);
  }
  // Differences of numbers, which wrap around 2^32.
  IntVec<D> step = IntVec<D>::Constant(-1);
  for (std::uint32_t& difference : steps_) {
    difference = index_of(step);
    for (int axis = 0; ++step[axis] > 1 && axis < D - 1; ++axis) step[axis] = -1;
  }
  heads_.assign(static_cast<std::size_t>(fit.prod()), kNone);
  places_.reserve(count_);
  next_.reserve(count_);
  make_blocks(fraction);
}

// The variance of a number over its mean is that of a large volume, d(n T)/dp at constant T.
template <int D>
void Growth<D>::make_blocks(double fraction) {
  constexpr int kCellsAlong = D == 2 ? 8 : 6;
  constexpr double kStep = 1e-4;
  const auto pressure = [](double phi) { return phi * compressibility(phi, 1.0, D); };
  const double variance = 2.0 * kStep * fraction /
                          (pressure((1.0 + kStep) * fraction) - pressure((1.0 - kStep) * fraction));
  const IntVec<D> along = (counts_ / kCellsAlong).cwiseMax(1);
  const double mean_of_cell = static_cast<double>(count_) / counts_.template cast<double>().prod();
  auto rest = static_cast<std::int64_t>(count_);
  IntVec<D> at = IntVec<D>::Zero();
  while (at[D - 1] < along[D - 1]) {
    Block block;
    for (int axis = 0; axis < D; ++axis) {
      const auto border = [&](std::int64_t number) {
        return static_cast<int>(number * counts_[axis] / along[axis]);
      };
      block.first[axis] = border(at[axis]);
      block.last[axis] = border(at[axis] + 1);
    }
    const double mean = mean_of_cell * (block.last - block.first).template cast<double>().prod();
    const double number = mean + std::sqrt(variance * mean) * random_.normal();
    block.missing = static_cast<int>(std::max(0.0, std::round(number)));
    rest -= block.missing;
    blocks_.push_back(block);
    for (int axis = 0; ++at[axis] == along[axis] && axis < D - 1; ++axis) at[axis] = 0;
  }
  while (rest != 0) {
    Block& block = blocks_[random_.below(blocks_.size())];
    const int change = rest > 0 ? 1 : -1;
    if (block.missing + change < 0) continue;
    block.missing += change;
    rest -= change;
  }
}

template <int D>
std::uint32_t Growth<D>::index_of(const IntVec<D>& cell) const {
  std::uint32_t index = 0;
  for (int axis = D - 1; axis >= 0; --axis) {
    index =
        index * static_cast<std::uint32_t>(counts_[axis]) + static_cast<std::uint32_t>(cell[axis]);
  }
  return index;
}

// Calls visit(particle, shift) for each particle in the cell of a place and in the adjacent ones.
// The shift leads to the particle's image near the place, unless the room is narrow.
template <int D>
template <class Visit>
void Growth<D>::visit_near(const Vec<D>& place, const Visit& visit) const {
  const auto visit_cell = [&](std::uint32_t cell, const Vec<D>& shift) {
    for (std::uint32_t i = heads_[cell]; i != kNone;) {
      const std::uint32_t following = next_[i];
      visit(i, shift);
      i = following;
    }
  };
  const IntVec<D> own = cell_at(place);
  bool inside = true;
  for (int axis = 0; axis < D; ++axis) {
    inside = inside && own[axis] > 0 && own[axis] < counts_[axis] - 1;
  }
  if (inside) {
    const Vec<D> none = Vec<D>::Zero();
    const std::uint32_t middle = index_of(own);
    for (const std::uint32_t step : steps_) visit_cell(middle + step, none);
    return;
  }
  IntVec<D> step = IntVec<D>::Constant(-1);
  while (step[D - 1] <= 1) {
    IntVec<D> cell = own + step;
    Vec<D> shift = Vec<D>::Zero();
    bool exists = true;
    for (int axis = 0; axis < D; ++axis) {
      const int count = counts_[axis];
      if (cell[axis] >= 0 && cell[axis] < count) continue;
      exists = exists && domain_.periodic[axis] && count >= 3;
      const int side = cell[axis] < 0 ? -1 : 1;
      cell[axis] -= side * count;
      shift[axis] = side * domain_.box[axis];
    }
    if (exists) visit_cell(index_of(cell), shift);
    for (int axis = 0; ++step[axis] > 1 && axis < D - 1; ++axis) step[axis] = -1;
  }
}

template <int D>
bool Growth<D>::advance(const StopRequest& pause) {
  if (!inserted_) {
    if (!insert(pause)) return false;
    inserted_ = true;
    if (places_.size() < count_) return true;
    sort_by_cell();
    has_moved_.assign(count_, 0);
    if (inserted_diameter_ < diameter_) {
      pass_.resize(count_);
      std::iota(pass_.begin(), pass_.end(), 0u);
    }
  }
  return part_pairs(pause);
}

template <int D>
double Growth<D>::progress() const {
  const double count = static_cast<double>(std::max<std::size_t>(1, count_));
  if (!inserted_) return 0.5 * static_cast<double>(places_.size()) / count;
  return 1.0 - 0.5 * static_cast<double>(pass_.size()) / count;
}

template <int D>
std::vector<Vec<D>> Growth<D>::take() {
  const bool overlaps = !pass_.empty() || places_.size() < count_;
  return overlaps ? std::vector<Vec<D>>() : std::exchange(places_, {});
}

// Sweeps through the blocks, with some tries in each of those that miss particles. Returns false at
// a request to pause.
template <int D>
bool Growth<D>::insert(const StopRequest& pause) {
  constexpr std::size_t kBlocksPerQuestion = 64;
  for (; places_.size() < count_ && passes_ < kMostPasses; ++passes_) {
    for (; next_block_ < blocks_.size(); ++next_block_) {
      if (next_block_ % kBlocksPerQuestion == 0 && pause.made()) return false;
      try_in(blocks_[next_block_]);
    }
    next_block_ = 0;
  }
  passes_ = 0;
  return true;
}

template <int D>
void Growth<D>::try_in(Block& block) {
  constexpr int kCellsPerTry = 3;
  const IntVec<D> cells = block.last - block.first;
  for (int tries = cells.prod() / kCellsPerTry + block.missing / 2 + 1; tries > 0; --tries) {
    if (block.missing == 0) return;
    Vec<D> place;
    for (int axis = 0; axis < D; ++axis) {
      const double cell = block.first[axis] + random_.uniform() * cells[axis];
      place[axis] = std::min(high_[axis], low_[axis] + cell * widths_[axis]);
    }
    bool is_free = true;
    visit_near(place, [&](std::uint32_t other, const Vec<D>& shift) {
      Vec<D> way = places_[other] + shift - place;
      if (is_narrow_) way = domain_.shortest(way);
      is_free = is_free && way.squaredNorm() >= inserted_diameter_ * inserted_diameter_;
    });
    if (!is_free) continue;
    const std::uint32_t cell = index_of(cell_at(place));
    next_.push_back(std::exchange(heads_[cell], static_cast<std::uint32_t>(places_.size())));
    places_.push_back(place);
    --block.missing;
  }
}

// Numbers the particles by cell, so that near particles are near in memory.
template <int D>
void Growth<D>::sort_by_cell() {
  std::vector<std::uint32_t> first(heads_.size() + 1, 0);
  for (const Vec<D>& place : places_) ++first[index_of(cell_at(place)) + 1];
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  std::vector<Vec<D>> sorted(places_.size());
  for (const Vec<D>& place : places_) sorted[first[index_of(cell_at(place))]++] = place;
  places_ = std::move(sorted);
  std::ranges::fill(heads_, kNone);
  next_.resize(places_.size());
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    next_[i] = std::exchange(heads_[index_of(cell_at(places_[i]))], i);
  }
}

// Passes over the particles that may overlap others, until there are none. Returns false at a
// request to pause.
template <int D>
bool Growth<D>::part_pairs(const StopRequest& pause) {
  constexpr std::size_t kParticlesPerQuestion = 1024;
  for (; !pass_.empty() && passes_ < kMostPasses; ++passes_) {
    for (; looked_at_ < pass_.size(); ++looked_at_) {
      if (looked_at_ % kParticlesPerQuestion == 0 && pause.made()) return false;
      part_from_others(pass_[looked_at_]);
    }
    for (const std::uint32_t i : moved_) has_moved_[i] = 0;
    pass_ = std::exchange(moved_, {});
    looked_at_ = 0;
  }
  return true;
}

// Moves a particle and each one that it overlaps apart, each by half of the way. The particle may
// change its cell meanwhile, and some of its neighbours are not seen. The next pass looks at it
// again.
template <int D>
void Growth<D>::part_from_others(std::uint32_t particle) {
  visit_near(places_[particle], [&](std::uint32_t other, const Vec<D>& shift) {
    if (other == particle) return;
    Vec<D> way = places_[other] + shift - places_[particle];
    if (is_narrow_) way = domain_.shortest(way);
    const double square = way.squaredNorm();
    if (square >= diameter_ * diameter_) return;
    const double length = std::sqrt(square);
    way = length > 0.0 ? Vec<D>(way / length) : Vec<D>(Vec<D>::Unit(0));
    const double apart = diameter_ + random_.uniform() * most_gap_ - length;
    move(particle, -0.5 * apart * way);
    move(other, 0.5 * apart * way);
  });
}

template <int D>
void Growth<D>::move(std::uint32_t particle, const Vec<D>& way) {
  const std::uint32_t before = index_of(cell_at(places_[particle]));
  Vec<D> place = domain_.wrapped(places_[particle] + way);
  for (int axis = 0; axis < D; ++axis) {
    if (!domain_.periodic[axis]) place[axis] = std::clamp(place[axis], low_[axis], high_[axis]);
  }
  places_[particle] = place;
  const std::uint32_t after = index_of(cell_at(place));
  if (after != before) {
    std::uint32_t* link = &heads_[before];
    while (*link != particle) link = &next_[*link];
    *link = next_[particle];
    next_[particle] = std::exchange(heads_[after], particle);
  }
  if (!std::exchange(has_moved_[particle], 1)) moved_.push_back(particle);
}

template class Growth<2>;
template class Growth<3>;

}  // namespace clatter
