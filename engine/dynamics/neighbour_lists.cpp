// Functions with vector arguments or results are inlined, so their calling convention does not
// matter.
#pragma GCC diagnostic ignored "-Wpsabi"

#include "engine/dynamics/neighbour_lists.h"

#include <bit>
#include <cstring>
#include <limits>
#include <numbers>

#include "engine/dynamics/prefetch.h"

namespace clatter {

// Distance of centres at contact in diameters, with a margin that exceeds any rounding.
static constexpr double kContact = 1.01;
// The mean number of neighbours. Measured best for N from 1372 to 87,808 at a volume fraction of
// 0.49.
static constexpr double kWanted = 11.0;
// The distance of a particle behind the centre of its new region, in radii. Measured best for N =
// 4000 and volume fractions from 0.4 to 0.5.
static constexpr double kLead = 0.4;
// A region shrinks or grows if its list is longer or shorter.
static constexpr std::size_t kLong = 17, kShort = 9;
static constexpr double kShrink = 0.85, kGrow = 1.1;
static constexpr double kMinRadius = 0.02;  // diameters
// Blocks that are compared between two visits of their particles: one bit each.
static constexpr int kBatch = 32;
// The coordinate of a place without a particle.
static constexpr float kNowhere = std::numeric_limits<float>::infinity();

// Radius of the regions of an evenly spread gas in which a particle has kWanted neighbours.
template <int D>
static double even_radius(const Model<D>& model, double particles, double contact) {
  const double volume = kWanted * model.box.prod() / std::max(1.0, particles);
  const double ball = D == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
  double low = 0.0, high = model.box.maxCoeff();
  for (int step = 0; step < 60; ++step) {
    const double radius = 0.5 * (low + high);
    // A cube with the volume of the ball, cut by walls.
    const double edge = std::pow(ball, 1.0 / D) * (contact + 2.0 * radius);
    double inside = 1.0;
    for (int axis = 0; axis < D; ++axis) {
      inside *= model.periodic(axis) ? edge : std::min(edge, model.box[axis]);
    }
    (inside < volume ? low : high) = radius;
  }
  return low;
}

// Mean distance at contact, with its margin.
static double mean_contact(double largest, const GrainArray& grains) {
  if (grains.empty()) return largest;
  double sum = 0.0;
  grains.for_each([&](const Grain& grain) { sum += 2.0 * kContact * grain.radius; });
  return sum / static_cast<double>(grains.size());
}

// Radius of a region as far as neighbours of the largest size are concerned: smaller particles
// touch them at smaller distances.
template <int D>
float NeighbourLists<D>::span_of(std::uint32_t particle) const {
  const double radius = regions_[particle].radius;
  if (grains_->empty()) return static_cast<float>(radius);
  const double smaller = 0.5 * contact_ - kContact * grains_->radius(particle);
  return static_cast<float>(radius - smaller);
}

template <int D>
NeighbourLists<D>::NeighbourLists(const Model<D>& model, const GrainArray& grains, double particles)
    : domain_(model.domain()),
      grains_(&grains),
      contact_(kContact * model.diameter),
      max_radius_(std::max(kMinRadius * model.diameter,
                           even_radius<D>(model, particles, mean_contact(contact_, grains)))),
      regions_(static_cast<std::size_t>(particles)) {
  // Two particles may touch through neighbouring periodic images only, so regions are narrower than
  // the box.
  for (int axis = 0; axis < D; ++axis) {
    if (!domain_.periodic[axis]) continue;
    max_radius_ = std::min(max_radius_, 0.5 * (domain_.box[axis] - contact_));
  }
  std::uint32_t stride = 1;
  for (int axis = 0; axis < D; ++axis) {
    const double cells = std::floor(domain_.box[axis] / (contact_ + 2.0 * max_radius_));
    counts_[axis] = static_cast<int>(std::max(1.0, cells));
    widths_[axis] = domain_.box[axis] / counts_[axis];
    const auto count = static_cast<std::uint32_t>(counts_[axis]);
    const bool periodic = domain_.periodic[axis];
    auto& steps = steps_[axis];
    for (std::uint32_t step = 0; step < count + 2; ++step) {
      steps.push_back({(periodic ? (step + count - 1) % count : step) * stride, 0});
    }
    if (periodic) {
      const int shift = kParticleBits<D> + 2 * axis;
      steps.front().wrap = Neighbour{0b11} << shift;
      steps.back().wrap = Neighbour{0b01} << shift;
    }
    stride *= periodic ? count : count + 2;  // the cells in a wall stay empty
  }
  blocks_.resize(stride);
  further_.resize(2 * kCells);
}

template <int D>
IntVec<D> NeighbourLists<D>::cell_at(const Vec<D>& position) const {
  return cell_of<D>(position, widths_, counts_);
}

template <int D>
std::uint32_t NeighbourLists<D>::first_block(const IntVec<D>& cell) const {
  std::uint32_t block = 0;
  for (int axis = 0; axis < D; ++axis) {
    block += steps_[axis][static_cast<std::size_t>(cell[axis]) + 1].block;
  }
  return block;
}

template <int D>
std::uint32_t NeighbourLists<D>::new_block() {
  if (spare_blocks_.empty()) return append_sparingly(blocks_);
  const std::uint32_t block = spare_blocks_.back();
  spare_blocks_.pop_back();
  return block;
}

template <int D>
NeighbourLists<D>::Block::Block() {
  centres.fill(Floats{} + kNowhere);
}

template <int D>
void NeighbourLists<D>::put_in_cell(std::uint32_t particle) {
  const Region& region = regions_[particle];
  const IntVec<D> cell = cell_at(region.centre);
  std::uint32_t at = first_block(cell);
  while (blocks_[at].next != kNone) at = blocks_[at].next;
  if (blocks_[at].count == kFour) {
    const std::uint32_t added = new_block();  // may move blocks_
    blocks_[at].next = added;
    at = added;
  }
  Block& block = blocks_[at];
  const std::uint32_t place = block.count++;
  for (int axis = 0; axis < D; ++axis) {
    const double from_corner = region.centre[axis] - cell[axis] * widths_[axis];
    block.centres[axis][place] = static_cast<float>(from_corner);
  }
  block.radii[place] = span_of(particle);
  block.particles[place] = particle;
}

// The last particle of the cell takes the place of the particle.
template <int D>
void NeighbourLists<D>::take_from_cell(std::uint32_t particle) {
  Block* block = &blocks_[first_block(cell_at(regions_[particle].centre))];
  Block* before = nullptr;
  Block* holder = nullptr;
  std::uint32_t place = 0;
  for (;; before = block, block = &blocks_[block->next]) {
    for (std::uint32_t k = 0; k < block->count; ++k) {
      if (block->particles[k] != particle) continue;
      holder = block;
      place = k;
    }
    if (block->next == kNone) break;
  }
  const std::uint32_t last = --block->count;
  for (int axis = 0; axis < D; ++axis) {
    holder->centres[axis][place] = block->centres[axis][last];
    block->centres[axis][last] = kNowhere;
  }
  holder->radii[place] = block->radii[last];
  holder->particles[place] = block->particles[last];
  if (last > 0 || !before) return;
  spare_blocks_.push_back(before->next);
  before->next = kNone;
}

template <int D>
void NeighbourLists<D>::prefetch_search(std::uint32_t particle) const {
  const IntVec<D> cell = cell_at(regions_[particle].centre);
  for (int k = 0; k < kCells; ++k) {
    std::uint32_t block = 0;
    for (int axis = 0, digits = k; axis < D; ++axis, digits /= 3) {
      block += steps_[axis][static_cast<std::size_t>(cell[axis] + digits % 3)].block;
    }
    prefetch(blocks_[block]);
  }
}

// A number whose bit k is set.
static std::int32_t bit_of(std::size_t k) {
  return static_cast<std::int32_t>(std::uint32_t{1} << k);
}

// Which particles of a block have regions near a centre; lanes are 0 or -1. `centre` is measured
// from the corner of the cell. Notes the block that continues this one.
template <int D>
[[gnu::always_inline]] inline typename NeighbourLists<D>::Ints NeighbourLists<D>::near_in(
    std::uint32_t block, int cell, const std::array<Floats, D>& centre, const Floats& reach) {
  const Block& compared = blocks_[block];
  further_[further_count_] = {compared.next, cell};
  further_count_ += compared.next != kNone;
  const Floats limit = compared.radii + reach;
  Floats beyond = -limit * limit;
  for (int axis = 0; axis < D; ++axis) {
    const Floats way = compared.centres[axis] - centre[axis];
    beyond += way * way;
  }
  return beyond < Floats{};
}

// Appends particles of up to kBatch blocks to found_. Bit k of a lane belongs to this lane of block
// k.
template <int D>
template <typename PlaceOf>
[[gnu::always_inline]] inline void NeighbourLists<D>::append_near(const Ints& near,
                                                                  const PlaceOf& place_of) {
  if (found_.size() < count_ + (kBatch + 1) * kFour) found_.resize(2 * count_ + 2 * kBatch * kFour);
  for (int half = 0; half < 2; ++half) {
    const auto low = static_cast<std::uint32_t>(near[2 * half]);
    const auto high = static_cast<std::uint32_t>(near[2 * half + 1]);
    for (std::uint64_t bits = low | std::uint64_t{high} << kBatch; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
      const Place place = place_of(bit % kBatch);
      const auto lane = 2 * static_cast<std::uint32_t>(half) + bit / kBatch;
      found_[count_++] = blocks_[place.block].particles[lane] | place.wrap;
    }
  }
}

// Compares a centre with the first blocks of the cells that have the same place along the axes
// above kAxis. `place` and `cell` are the parts of these axes.
template <int D>
template <int kAxis>
[[gnu::always_inline]] inline void NeighbourLists<D>::compare_cells(Surroundings& around,
                                                                    const Place& place,
                                                                    std::array<Floats, D> centre,
                                                                    int cell) {
#pragma GCC unroll 3
  for (int step = 0; step < 3; ++step) {
    const Place& along = around.steps[kAxis][step];
    const Place next = {place.block + along.block, place.wrap | along.wrap};
    centre[kAxis] = around.centre[kAxis][step];
    if constexpr (kAxis > 0) {
      compare_cells<kAxis - 1>(around, next, centre, 3 * (cell + step));
    } else {
      const int number = cell + step;
      around.firsts[number] = next;
      around.near |= near_in(next.block, number, centre, around.reach) &
                     bit_of(static_cast<std::size_t>(number));
    }
  }
}

// Finds the particles whose regions are near that of a particle, which is not in a cell.
template <int D>
void NeighbourLists<D>::find_neighbours(std::uint32_t particle) {
  const Region& region = regions_[particle];
  const IntVec<D> cell = cell_at(region.centre);
  Surroundings around;
  for (int axis = 0; axis < D; ++axis) {
    around.steps[axis] = &steps_[axis][static_cast<std::size_t>(cell[axis])];
    for (int step = 0; step < 3; ++step) {
      const double from_corner = region.centre[axis] - (cell[axis] + step - 1) * widths_[axis];
      around.centre[axis][step] = Floats{} + static_cast<float>(from_corner);
    }
  }
  around.reach = Floats{} + (static_cast<float>(contact_) + span_of(particle));
  count_ = further_count_ = 0;
  compare_cells<D - 1>(around, {}, {}, 0);
  append_near(around.near, [&](std::uint32_t k) { return around.firsts[k]; });

  for (std::size_t begin = 0; begin < further_count_; begin += kBatch) {
    Ints near{};
    for (std::size_t k = begin; k < std::min(further_count_, begin + kBatch); ++k) {
      if (further_count_ + kCells > further_.size()) further_.resize(2 * further_.size());
      const auto [block, number] = further_[k];
      std::array<Floats, D> centre;
      for (int axis = 0, digits = number; axis < D; ++axis, digits /= 3) {
        centre[axis] = around.centre[axis][digits % 3];
      }
      near |= near_in(block, number, centre, around.reach) & bit_of(k - begin);
    }
    append_near(near, [&](std::uint32_t k) {
      const auto [block, number] = further_[begin + k];
      return Place{block, around.firsts[number].wrap};
    });
  }
}

// Replaces a list by found_.
template <int D>
void NeighbourLists<D>::fill(List& list) {
  continuations_.clear(list);
  for (std::size_t k = 0; k < count_; ++k) continuations_.put_on(list, found_[k]);
}

// Whether all lanes are zero.
template <class Ints>
static bool is_zero(const Ints& lanes) {
  std::array<std::int64_t, 2> halves;
  static_assert(sizeof halves == sizeof lanes);
  std::memcpy(halves.data(), &lanes, sizeof halves);
  return (halves[0] | halves[1]) == 0;
}

// Gives a particle the list found_, and enters the difference in the lists of its neighbours.
template <int D>
void NeighbourLists<D>::mend_lists(std::uint32_t particle) {
  // The wrap of the particle as seen from a neighbour is the opposite of the neighbour's wrap.
  const auto seen_from = [&](Neighbour neighbour) {
    constexpr Neighbour kLowBits = (D == 2 ? Neighbour{0b0101} : Neighbour{0b010101})
                                   << kParticleBits<D>;
    const Neighbour wrap = neighbour - particle_of<D>(neighbour);
    return particle | (wrap ^ ((wrap & kLowBits) << 1));
  };
  // Compares four elements at a time, because branches on them would be unpredictable.
  for (std::size_t k = count_; k % kFour != 0; ++k) found_[k] = kNobody;
  kept_.assign(count_ + kFour, 0);
  for (const Neighbour neighbour : known_) {
    Ints same{};
    for (std::size_t k = 0; k < count_; k += kFour) {
      Ints four, kept;
      std::memcpy(&four, &found_[k], sizeof four);
      std::memcpy(&kept, &kept_[k], sizeof kept);
      const Ints equal = four == static_cast<std::int32_t>(neighbour);
      same |= equal;
      kept |= equal;
      std::memcpy(&kept_[k], &kept, sizeof kept);
    }
    if (is_zero(same)) {
      continuations_.take_off(regions_[particle_of<D>(neighbour)].list, seen_from(neighbour));
    }
  }
  for (std::size_t k = 0; k < count_; ++k) {
    if (kept_[k]) continue;
    continuations_.put_on(regions_[particle_of<D>(found_[k])].list, seen_from(found_[k]));
  }
  fill(regions_[particle].list);
}

// Each pair is compared once, from the later particle. So its two entries agree at any rounding.
template <int D>
void NeighbourLists<D>::place(std::uint32_t particle, const Vec<D>& position) {
  regions_[particle].centre = position;
  regions_[particle].radius = max_radius_;
  find_neighbours(particle);
  put_in_cell(particle);
  known_.clear();
  mend_lists(particle);
}

template <int D>
Vec<D> NeighbourLists<D>::leave(const Model<D>& model, const Flight<D>& flight, const Vec<D>& image,
                                std::uint32_t number, double now) {
  take_from_cell(number);
  Region& region = regions_[number];
  known_.clear();
  continuations_.append_to(known_, region.list);
  if (known_.size() > kLong) {
    region.radius = std::max(kMinRadius * model.diameter, kShrink * region.radius);
  } else if (known_.size() < kShort) {
    region.radius = std::min(kGrow * region.radius, max_radius_);
  }
  Vec<D> centre = flight.at(now, model.gravity) - domain_.shift(image);
  const Vec<D> velocity = flight.velocity_at(now, model.gravity);
  const double speed = velocity.norm();
  if (speed > 0.0) centre += velocity * (kLead * region.radius / speed);
  const Vec<D> moved = domain_.image_at(centre);
  region.centre = centre - domain_.shift(moved);
  find_neighbours(number);
  put_in_cell(number);
  mend_lists(number);
  return moved;
}

template class NeighbourLists<2>;
template class NeighbourLists<3>;

}  // namespace clatter
