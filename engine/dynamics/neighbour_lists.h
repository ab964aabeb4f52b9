#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/cell_of.h"
#include "engine/dynamics/event.h"
#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/large_array.h"
#include "engine/dynamics/near_list.h"
#include "engine/laws/model.h"
#include "engine/physics/flight.h"
#include "engine/physics/pair_contact.h"
#include "engine/vec.h"

namespace clatter {

/// Lists of near particles, one per particle. Each particle has a region, a ball about a centre. It
/// gets a new region before it leaves the ball. Its list holds all particles that it can touch
/// while both are in their regions.
///
/// The search for new neighbours uses cells of the centres. The region of a particle shrinks in
/// dense surroundings, where its list would become long.
template <int D>
class NeighbourLists {
 public:
  static constexpr int kCapacity = 22;
  using List = NearList<kCapacity>;

  /// Empty lists for a number of particles. Periodic sides must not be below kMinSide. `grains` are
  /// those of a mixture, empty if all are alike, and must outlive the lists.
  NeighbourLists(const Model<D>& model, const GrainArray& grains, double particles);

  /// Narrowest periodic side of a box, in diameters.
  static constexpr double kMinSide = 1.5;

  /// Puts a particle at a position inside the box, and enters it in the lists.
  void place(std::uint32_t particle, const Vec<D>& position);

  /// Least distance of a particle in its region from the lower or upper end of the box.
  double distance_from_end(std::uint32_t particle, int axis, bool upper) const {
    const Region& region = regions_[particle];
    const double centre = region.centre[axis];
    return (upper ? domain_.box[axis] - centre : centre) - region.radius;
  }
  /// A time by which a particle needs a new region. Under gravity it may precede the exit. `image`
  /// is in whole box lengths, from the region's frame to the flight's frame.
  template <bool kFalling>
  Exit exit(const Model<D>& model, const Flight<D>& flight, const Vec<D>& image,
            std::uint32_t number, double now) const;
  /// Gives a particle a new region. Returns its shift to another periodic image, in box lengths.
  Vec<D> leave(const Model<D>& model, const Flight<D>& flight, const Vec<D>& image,
               std::uint32_t number, double now);

  /// Prefetches the cells that leave() searches for a particle.
  void prefetch_search(std::uint32_t particle) const;

  /// The list of a particle.
  const List& near(std::uint32_t particle) const { return regions_[particle].list; }
  /// The lists that continue the lists of particles.
  const Continuations<D, List>& continuations() const { return continuations_; }

 private:
  static constexpr int kFour = 4;
  static constexpr int kCells = D == 2 ? 9 : 27;  // a cell and its neighbours
  using Floats = float __attribute__((vector_size(4 * kFour)));
  using Ints = std::int32_t __attribute__((vector_size(4 * kFour)));
  static constexpr std::uint32_t kNone = List::kNone;

  struct alignas(64) Region {
    List list;
    Vec<D> centre = Vec<D>::Zero();  // in the box
    double radius = 0.0;
  };
  // Up to four particles of a cell. Single precision is enough with the margin of kContact.
  struct Block {
    std::array<Floats, D> centres;  // from the lower corner of the cell; beyond the count: infinity
    Floats radii{};
    std::array<std::uint32_t, kFour> particles{};
    std::uint32_t next = kNone;  // block of the same cell, if this one is full
    std::uint32_t count = 0;

    Block();
  };
  // A block of a neighbouring cell, or the part of its index along one axis.
  struct Place {
    std::uint32_t block = 0;
    Neighbour wrap = 0;  // of the particles there
  };
  // A block after the first of one of the cells around a centre.
  struct Further {
    std::uint32_t block = 0;
    int cell = 0;
  };
  // The cells around a centre. They have numbers, which count fastest along the first axis.
  struct Surroundings {
    std::array<const Place*, D> steps;
    std::array<std::array<Floats, 3>, D> centre;  // from the corners of the cells along each axis
    Floats reach;
    std::array<Place, kCells> firsts;  // the first block of each cell
    Ints near{};                       // bit k of a lane: whether this particle of block k is near
  };

  IntVec<D> cell_at(const Vec<D>& position) const;
  std::uint32_t first_block(const IntVec<D>& cell) const;
  std::uint32_t new_block();
  void put_in_cell(std::uint32_t particle);
  void take_from_cell(std::uint32_t particle);
  void find_neighbours(std::uint32_t particle);
  template <int kAxis>
  void compare_cells(Surroundings& around, const Place& place, std::array<Floats, D> centre,
                     int cell);
  Ints near_in(std::uint32_t block, int cell, const std::array<Floats, D>& centre,
               const Floats& reach);
  template <typename PlaceOf>
  void append_near(const Ints& near, const PlaceOf& place_of);
  void fill(List& list);
  void mend_lists(std::uint32_t particle);

  float span_of(std::uint32_t particle) const;

  Domain<D> domain_;
  const GrainArray* grains_;  // a pointer, so that lists can be assigned
  double contact_;            // largest distance of centres at contact, with a margin
  double max_radius_;         // of regions
  IntVec<D> counts_;
  Vec<D> widths_;
  std::array<std::vector<Place>, D> steps_;  // [counts + 2] along each axis: of cells -1 ... counts
  LargeArray<Region> regions_;               // [N]
  Continuations<D, List> continuations_;
  LargeArray<Block> blocks_;  // the first block of each cell, then further blocks
  std::vector<std::uint32_t> spare_blocks_;
  std::vector<Neighbour> known_;  // the list of a particle that gets a new one
  std::vector<Neighbour> found_;  // the new list, and room for a batch
  std::size_t count_ = 0;         // of the new list
  std::vector<Neighbour> kept_;   // for each element of the new list: not 0 if it is known
  std::vector<Further> further_;  // blocks to compare, and room for kCells more
  std::size_t further_count_ = 0;
};

template <int D>
template <bool kFalling>
[[gnu::always_inline]] inline Exit NeighbourLists<D>::exit(const Model<D>& model,
                                                           const Flight<D>& flight,
                                                           const Vec<D>& image,
                                                           std::uint32_t number, double now) const {
  const Region& region = regions_[number];
  const double since = now - flight.time;
  Vec<D> v = flight.v;
  Vec<D> r = flight.r - domain_.shift(image);
  double radius = region.radius;
  double latest = kNever;
  if constexpr (kFalling) {
    // In this time gravity bends the path by a quarter of the radius.
    latest = std::sqrt(0.5 * radius / model.gravity.norm());
    radius *= 0.75;
    r += (v + model.gravity * (0.5 * since)) * since;
    v += model.gravity * since;
  } else {
    r += v * since;
  }
  const Vec<D> d = r - region.centre;
  // The later root of |d + v t| = radius, in the form without cancellation. A particle at rest
  // leaves never: the time is infinite or NaN.
  const double depth = radius * radius - d.squaredNorm();
  const double square = v.squaredNorm(), rate = d.dot(v);
  const double sum = std::sqrt(rate * rate + square * depth) + std::fabs(rate);
  const double stay = (rate < 0.0 ? sum : depth) / (rate < 0.0 ? square : sum);
  // A particle inside of its region gets a new one later, at least by the smallest time step.
  double time = depth > 0.0 ? now + std::min(latest, stay) : now;
  if (depth > 0.0 && time == now) [[unlikely]]
    time = std::nextafter(now, kNever);
  return {time, kCellBorder};
}

extern template class NeighbourLists<2>;
extern template class NeighbourLists<3>;

}  // namespace clatter
