// Functions with vector arguments or results are inlined, so their calling convention does not
// matter.
#pragma GCC diagnostic ignored "-Wpsabi"

#include "engine/dynamics/neighbour_lists.h"

#include <cstring>
#include <numbers>

#include "engine/dynamics/prefetch.h"

namespace clatter {

// Distance of centres at contact in diameters, with a margin that exceeds any rounding.
static constexpr double kContact = 1.01;
// Measured best for N = 4000 and volume fractions from 0.4 to 0.5: the mean number of neighbours,
// and the distance of a particle behind the centre of its new region, in radii.
static constexpr double kWanted = 12.0;
static constexpr double kLead = 0.4;
// A region shrinks or grows if its list is longer or shorter.
static constexpr std::size_t kLong = 17, kShort = 9;
static constexpr double kShrink = 0.85, kGrow = 1.1;
static constexpr double kMinRadius = 0.02;  // diameters

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

template <int D>
NeighbourLists<D>::NeighbourLists(const Model<D>& model, double particles)
    : box_(model.box),
      contact_(kContact * model.diameter),
      max_radius_(
          std::max(kMinRadius * model.diameter, even_radius<D>(model, particles, contact_))),
      regions_(static_cast<std::size_t>(particles)) {
  // Two particles may touch through neighbouring periodic images only, so regions are narrower than
  // the box.
  for (int axis = 0; axis < D; ++axis) {
    if (model.periodic(axis)) max_radius_ = std::min(max_radius_, 0.5 * (box_[axis] - contact_));
  }
  std::uint32_t stride = 1;
  for (int axis = 0; axis < D; ++axis) {
    const double cells = std::floor(box_[axis] / (contact_ + 2.0 * max_radius_));
    counts_[axis] = static_cast<int>(std::max(1.0, cells));
    widths_[axis] = box_[axis] / counts_[axis];
    const auto count = static_cast<std::uint32_t>(counts_[axis]);
    auto& steps = steps_[axis];
    steps.resize(count + 2);
    for (std::uint32_t cell = 0; cell < count; ++cell) steps[cell + 1].index = cell * stride;
    if (model.periodic(axis)) {
      const int shift = kParticleBits<D> + 2 * axis;
      steps.front() = {steps[count].index, Neighbour{0b11} << shift};
      steps.back() = {steps[1].index, Neighbour{0b01} << shift};
    }
    stride *= count;
  }
  blocks_.resize(stride);
  found_.resize(64);
}

template <int D>
IntVec<D> NeighbourLists<D>::cell_at(const Vec<D>& position) const {
  return cell_of<D>(position, widths_, counts_);
}

template <int D>
std::uint32_t NeighbourLists<D>::first_block(const IntVec<D>& cell) const {
  std::uint32_t block = 0;
  for (int axis = 0; axis < D; ++axis) {
    block += steps_[axis][static_cast<std::size_t>(cell[axis]) + 1].index;
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
void NeighbourLists<D>::put_in_cell(std::uint32_t particle) {
  const Region& region = regions_[particle];
  const IntVec<D> cell = cell_at(region.centre);
  std::uint32_t at = first_block(cell);
  std::size_t place = 0;
  while (blocks_[at].particles[place] != kNobody) {
    if (++place < kFour) continue;
    place = 0;
    if (blocks_[at].next == kNone) {
      const std::uint32_t added = new_block();  // may move blocks_
      blocks_[at].next = added;
    }
    at = blocks_[at].next;
  }
  Block& block = blocks_[at];
  for (int axis = 0; axis < D; ++axis) {
    const double from_corner = region.centre[axis] - cell[axis] * widths_[axis];
    block.centres[axis][place] = static_cast<float>(from_corner);
  }
  block.radii[place] = static_cast<float>(region.radius);
  block.particles[place] = particle;
}

// The last particle of the cell takes the place of the particle.
template <int D>
void NeighbourLists<D>::take_from_cell(std::uint32_t particle) {
  Block* block = &blocks_[first_block(cell_at(regions_[particle].centre))];
  Block* before = nullptr;
  Block* holder = nullptr;
  std::size_t place = 0;
  for (;; before = block, block = &blocks_[block->next]) {
    for (std::size_t k = 0; k < kFour; ++k) {
      if (block->particles[k] != particle) continue;
      holder = block;
      place = k;
    }
    if (block->next == kNone) break;
  }
  std::size_t last = kFour - 1;
  while (block->particles[last] == kNobody) --last;
  for (int axis = 0; axis < D; ++axis) {
    holder->centres[axis][place] = block->centres[axis][last];
  }
  holder->radii[place] = block->radii[last];
  holder->particles[place] = block->particles[last];
  block->particles[last] = kNobody;
  if (last > 0 || !before) return;
  spare_blocks_.push_back(before->next);
  before->next = kNone;
}

// Adds the particles of a cell whose regions are near to found_. `centre` is the centre of the
// particle's region, from the corner of the cell.
template <int D>
[[gnu::always_inline]] inline void NeighbourLists<D>::find_in_cell(
    std::uint32_t at, Neighbour wrap, const std::array<Floats, D>& centre, Floats reach,
    std::uint32_t particle) {
  for (; at != kNone; at = blocks_[at].next) {
    const Block& block = blocks_[at];
    Floats square{};
    for (int axis = 0; axis < D; ++axis) {
      const Floats way = block.centres[axis] - centre[axis];
      square += way * way;
    }
    const Floats limit = block.radii + reach;
    const Ints near = square < limit * limit;
    std::array<std::int64_t, 2> any;
    std::memcpy(any.data(), &near, sizeof any);
    if ((any[0] | any[1]) == 0) continue;
    if (count_ + kFour > found_.size()) found_.resize(2 * found_.size());
    for (std::size_t k = 0; k < kFour; ++k) {
      const std::uint32_t other = block.particles[k];
      found_[count_] = other | wrap;
      count_ += (near[k] != 0) & (other != kNobody) & (other != particle);
    }
  }
}

template <int D>
void NeighbourLists<D>::prefetch_search(std::uint32_t particle) const {
  const IntVec<D> cell = cell_at(regions_[particle].centre);
  for (int k = 0; k < kCells; ++k) {
    std::uint32_t block = 0;
    bool exists = true;
    for (int axis = 0, digits = k; axis < D; ++axis, digits /= 3) {
      const Step& step = steps_[axis][static_cast<std::size_t>(cell[axis] + digits % 3)];
      block += step.index;
      exists = exists && step.index != kNone;
    }
    if (exists) prefetch(blocks_[block]);
  }
}

template <int D>
void NeighbourLists<D>::find_neighbours(std::uint32_t particle) {
  const Region& region = regions_[particle];
  const IntVec<D> cell = cell_at(region.centre);
  std::array<std::array<Floats, 3>, D> centre;  // from the corners of the neighbouring cells
  std::array<const Step*, D> steps;
  for (int axis = 0; axis < D; ++axis) {
    steps[axis] = &steps_[axis][static_cast<std::size_t>(cell[axis])];
    for (int step = 0; step < 3; ++step) {
      const double from_corner = region.centre[axis] - (cell[axis] + step - 1) * widths_[axis];
      centre[axis][step] = Floats{} + static_cast<float>(from_corner);
    }
  }
  const Floats reach = Floats{} + static_cast<float>(contact_ + region.radius);
  count_ = 0;
  for (int k = 0; k < kCells; ++k) {
    std::array<Floats, D> from;
    std::uint32_t block = 0;
    Neighbour wrap = 0;
    bool exists = true;
    for (int axis = 0, digits = k; axis < D; ++axis, digits /= 3) {
      const Step& step = steps[axis][digits % 3];
      from[axis] = centre[axis][digits % 3];
      block += step.index;
      wrap |= step.wrap;
      exists = exists && step.index != kNone;
    }
    if (exists) find_in_cell(block, wrap, from, reach, particle);
  }
}

// Replaces a list by found_.
template <int D>
void NeighbourLists<D>::fill(List& list) {
  continuations_.clear(list);
  for (std::size_t k = 0; k < count_; ++k) continuations_.put_on(list, found_[k]);
}

static bool contains(const Neighbour* first, std::size_t count, Neighbour wanted) {
  Neighbour found = 0;
  for (std::size_t k = 0; k < count; ++k) found |= first[k] == wanted;
  return found;
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
  for (const Neighbour neighbour : known_) {
    if (contains(found_.data(), count_, neighbour)) continue;
    continuations_.take_off(regions_[particle_of<D>(neighbour)].list, seen_from(neighbour));
  }
  for (std::size_t k = 0; k < count_; ++k) {
    if (contains(known_.data(), known_.size(), found_[k])) continue;
    continuations_.put_on(regions_[particle_of<D>(found_[k])].list, seen_from(found_[k]));
  }
  fill(regions_[particle].list);
}

// Each pair is compared once, from the later particle. So its two entries agree at any rounding.
template <int D>
void NeighbourLists<D>::place(std::uint32_t particle, const Vec<D>& position) {
  regions_[particle].centre = position;
  regions_[particle].radius = max_radius_;
  put_in_cell(particle);
  find_neighbours(particle);
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
  Vec<D> centre = flight.at(now, model.gravity) - image.cwiseProduct(box_);
  const Vec<D> velocity = flight.velocity_at(now, model.gravity);
  const double speed = velocity.norm();
  if (speed > 0.0) centre += velocity * (kLead * region.radius / speed);
  const Vec<D> boxes = model.image_index(centre);
  region.centre = centre - boxes.cwiseProduct(box_);
  put_in_cell(number);
  find_neighbours(number);
  mend_lists(number);
  return boxes;
}

template class NeighbourLists<2>;
template class NeighbourLists<3>;

}  // namespace clatter
