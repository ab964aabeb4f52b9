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
#include "engine/dynamics/neighbour.h"
#include "engine/dynamics/subdomain.h"
#include "engine/laws/model.h"
#include "engine/physics/fall_time.h"
#include "engine/physics/flight.h"
#include "engine/physics/state.h"
#include "engine/vec.h"

namespace clatter {

/// Diameters of the particles of a grid.
struct GridSizes {
  double base;     ///< cells are wider, and particles up to this diameter have reach 1
  double largest;  ///< of all particles, >= base
};

/// The sizes for the fastest search among particles in a box: `base` is one of their diameters.
template <int D>
GridSizes grid_sizes(const Model<D>& model, const GrainArray& grains);

/// Number of lists along an axis that a particle with a reach above 1 reads.
inline int lists_along(int reach) {
  return (2 * reach + 3) / 3;
}

/// Grid of cells that finds near particles. Two particles that touch and that are alike belong to
/// the same cell or to neighbouring cells. A particle stays in its cell until it is beyond the
/// cell's border by an overhang. This hysteresis prevents repeated crossings; the overhang is as
/// wide as the first condition allows.
///
/// The list of a cell holds the particles of the cell and of all neighbouring cells. If the box is
/// only one or two cells wide, a particle occurs several times with different wraps. A search for
/// partners reads one list. A crossing removes the particle from one row of lists and adds it to
/// another. Searches are far more frequent than crossings.
///
/// In a sheared box the cells move with the flow: their places along x are those of x - s y, with
/// the strain s. So neighbours stay neighbours, also across the border, where a row has slid by a
/// whole number of cells. The strain must stay between -most_strain() and most_strain(). At the end
/// of this range lay_with_flow() subtracts from it, and particles are sorted into cells again.
///
/// In a mixture the cells may be smaller than large particles. A particle is on the lists of all
/// cells within its reach, a number of cells along each axis. The reach is 1 up to the base
/// diameter. Beyond it any particle of the base diameter that touches has the large particle on its
/// list. A large particle reads several lists, which lie three cells apart (visit_wide).
template <int D>
class CellGrid {
 public:
  /// Cells of an evenly spread gas for each particle. With fewer cells the lists of spheres are
  /// longer and overflow; with more cells spheres cross borders more often. Measured best for
  /// volume fractions from 0.05 to 0.3.
  static constexpr double kCellsPerParticle = D == 2 ? 1.0 : 1.3;

  /// An empty grid over a subdomain, of about so many cells, each wider than the base diameter. In
  /// a narrow periodic box the base diameter is the largest one.
  CellGrid(const Subdomain<D>& subdomain, const GridSizes& sizes, double cells);
  /// The same over the whole box, for particles that are alike.
  CellGrid(const Model<D>& model, double cells)
      : CellGrid(whole_box<D>(model), {model.diameter, model.diameter}, cells) {}

  /// Whether some particle has a reach above 1.
  bool has_wide() const { return base_ < sizes_.largest; }
  /// Reach of a particle.
  int reach_of(double diameter) const { return diameter <= base_ ? 1 : wide_reach(diameter); }
  /// Puts a particle into a cell.
  void insert(std::uint32_t particle, const IntVec<D>& cell, int reach = 1);
  /// Puts particles of reach 1 into their cells, in an empty grid. Numbers them by cell: the new
  /// particle k is the element order[k] of `cells`.
  void fill(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order);
  /// The order of particles by cell: the k-th has the cell cells[order[k]].
  void sort(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order) const {
    std::vector<std::uint32_t> starts;
    sort(cells, order, starts);
  }
  /// Removes a particle from its cell.
  void remove(std::uint32_t particle, const IntVec<D>& cell, int reach = 1);
  /// Moves a particle from its cell to the neighbour along an axis, on the side of `step` = +1 or
  /// -1.
  void move(std::uint32_t particle, const IntVec<D>& cell, int axis, int step, int reach = 1);

  /// The number of a cell, from 0 to the product of counts().
  std::size_t number_of(const IntVec<D>& cell) const { return index(cell); }
  /// Number of cells along each axis.
  const IntVec<D>& counts() const { return counts_; }
  /// The cell that holds a position inside the subdomain.
  IntVec<D> cell_at(const Vec<D>& position) const;
  /// The cell next to one along an axis, on the side of `step` = +1 or -1, across the periodic
  /// border.
  IntVec<D> neighbour(IntVec<D> cell, int axis, int step) const {
    cell[axis] += step;
    if (cell[axis] < 0 || cell[axis] == counts_[axis]) {
      cell[axis] -= step * counts_[axis];
      if (slides_ && axis == 1) cell[0] = within_row(cell[0] - step * slid_);
    }
    return cell;
  }
  /// Whether a particle that crosses a border of its cell leaves the subdomain.
  bool leaves_subdomain(const IntVec<D>& cell, std::uint32_t border) const {
    if (!open_) return false;
    const auto [axis, step] = crossing_of(border);
    const IntVec<D> next = neighbour(cell, axis, step);
    const End end = subdomain_.ends[static_cast<std::size_t>(2 * axis + (step > 0))];
    return end == End::Open && next[axis] != cell[axis] + step;
  }
  /// Coordinate at which a particle leaves cell number `cell` through its upper or lower border,
  /// overhang included. Infinite at a wall, which has no cell beyond it.
  double border(int axis, int cell, bool upper) const {
    return borders_[axis][static_cast<std::size_t>(2 * cell + upper)];
  }

  static_assert(kMaxParticles<D> < (std::uint64_t{1} << kParticleBits<D>));  // the last is kNobody
  /// A list fills one cache line in 2D and two in 3D.
  static constexpr int kCapacity = D == 2 ? 14 : 30;
  struct alignas(64) List : NearList<kCapacity> {};

  /// Least distance of a particle in a cell from the lower or upper end of the box.
  double distance_from_end(const IntVec<D>& cell, int axis, bool upper) const {
    const int cells = upper ? counts_[axis] - 1 - cell[axis] : cell[axis];
    const double beyond = subdomain_.to_box_end[static_cast<std::size_t>(2 * axis + upper)];
    return beyond + cells * widths_[axis] - overhangs_[axis];
  }
  /// The exits of a particle from its cell along each axis. `image` is in whole box lengths, from
  /// the cell's frame to the flight's frame.
  template <bool kFalling>
  std::array<Exit, D> exits(const Model<D>& model, const Flight<D>& flight, const Vec<D>& image,
                            const IntVec<D>& cell, double now) const;
  /// Moves a particle across a border of its cell. Returns its shift to another periodic image, in
  /// box lengths.
  Vec<D> leave(std::uint32_t particle, IntVec<D>& cell, std::uint32_t border, int reach = 1);
  /// Adapts the number of cells to a sum over all particles of the numbers near each. Cells for the
  /// mean density have long lists in clusters; finer cells shorten these lists, up to a limit of
  /// memory. Returns whether the number has changed; the grid then is empty.
  bool fit(double particles, double near);
  /// Empties the grid and lays it over another subdomain. Keeps the memory of its lists.
  void reset(const Subdomain<D>& subdomain, const GridSizes& sizes, double cells);

  /// The list of a cell.
  const List& near(const IntVec<D>& cell) const { return lists_[index(cell)]; }
  /// The lists that continue the lists of cells.
  const Continuations<D, List>& continuations() const { return continuations_; }
  /// Calls visit(particle, wrap) for each particle near a cell. `wrap` is its periodic image in box
  /// lengths.
  template <typename Visit>
  void visit(const IntVec<D>& cell, const Visit& visit) const {
    continuations_.visit(near(cell), visit);
  }

  /// Calls visit(list, wrap) for the lists that a particle with a reach above 1 reads in a cell.
  /// `wrap` is the periodic image of the list's cell, in box lengths: it adds to the wraps of the
  /// neighbours. A neighbour may be on several of these lists.
  template <typename Visit>
  void visit_wide(const IntVec<D>& cell, int reach, const Visit& visit) const;

  /// Removes all particles.
  void clear();
  /// Chooses the strain of the cells of a sheared box at the time `now`. The grid must be empty.
  /// `domain` has the offset of time 0. Without effect in other boxes.
  void lay_with_flow(const Domain<D>& domain, double now);
  /// Box lengths along x by which the next image above has slid, beside the wraps of neighbours. A
  /// neighbour with the wrap w along y is w times so many boxes farther to the left.
  int boxes_slid() const { return boxes_slid_; }
  /// Time at which the strain of the cells is largest; kNever: it is constant.
  double flow_ends() const { return flow_ends_; }
  /// The place in the cells of a sheared box of a position, in the box, at a time. Along x it may
  /// be in the next image.
  Vec<D> with_flow(Vec<D> position, double time) const {
    position[0] -= strain_at(time) * (position[1] - middle());
    return position;
  }
  /// The exits of a particle from its cell in a sheared box, without gravity, see exits(). The
  /// domain has the offset of time 0.
  std::array<Exit, D> flow_exits(const Domain<D>& domain, const Flight<D>& flight,
                                 const Vec<D>& image, const IntVec<D>& cell, double now) const;

  /// Calls visit(list) for the first list of each cell that move() changes, for a reach of 1.
  /// Across a periodic border move() changes further lists.
  template <typename Visit>
  void visit_moved(const IntVec<D>& cell, int axis, int step, const Visit& visit) const;

 private:
  // A cell along one axis. There are margin_ more beyond either end.
  static constexpr std::uint32_t kNone = List::kNone;
  struct Place {
    std::uint32_t index = kNone;  // this axis' part of the index of its list; kNone: no cell
    Neighbour wrap = 0;           // wrap of a particle within the box, seen from there
  };
  struct Block {
    IntVec<D> from;
    IntVec<D> to;
  };
  static Block about(const IntVec<D>& cell, int reach = 1);
  static Block row(const IntVec<D>& cell, int axis, int at, int reach = 1);

  template <int Axis, typename Visit>
  void visit_lists(const Block& block, std::uint32_t index, Neighbour wrap, const Visit& visit,
                   int slid = 0) const;
  double strain_at(double time) const { return strain_ + strain_rate_ * time; }
  // Height at which the flow rests, and the cells with it.
  double middle() const { return 0.5 * (subdomain_.lower[1] + subdomain_.upper[1]); }
  int within_row(int at) const {
    const int rest = at % counts_[0];
    return rest < 0 ? rest + counts_[0] : rest;
  }
  void sort(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order,
            std::vector<std::uint32_t>& starts) const;
  bool fill_by_rows(List& list, const IntVec<D>& cell,
                    const std::vector<std::uint32_t>& starts) const;
  void fill_by_cells(List& list, const IntVec<D>& cell, const std::vector<std::uint32_t>& starts);
  std::uint32_t index(const IntVec<D>& cell) const;
  int wide_reach(double diameter) const;
  Exit exit_falling(const Model<D>& model, const Flight<D>& flight, const Vec<D>& image,
                    const IntVec<D>& cell, int axis, double now) const;

  Subdomain<D> subdomain_;
  bool open_;        // whether particles can leave the subdomain
  bool slides_;      // whether the ends along y slide
  int slid_ = 0;     // cells along x by which the row above the border has slid, and whole boxes
  int boxes_slid_ = 0;
  double strain_ = 0.0, strain_rate_ = 0.0;  // of the cells of a sheared box, at time 0
  double flow_ends_ = kNever;
  GridSizes sizes_;  // requested
  double base_;      // in force: in a narrow box the largest diameter
  int margin_ = 1;   // reach of the largest particle
  double cells_;     // requested
  IntVec<D> counts_;
  IntVec<D> strides_;
  Vec<D> widths_;
  Vec<D> overhangs_;
  std::array<std::vector<double>, D> borders_;  // [2 counts] along each axis: lower, upper, ...
  std::array<std::vector<Place>, D> places_;    // [counts + 2 margin_] along each axis
  LargeArray<List> lists_;                      // of each cell
  Continuations<D, List> continuations_;
};

template <int D>
[[gnu::always_inline]] inline std::uint32_t CellGrid<D>::index(const IntVec<D>& cell) const {
  return static_cast<std::uint32_t>(cell.dot(strides_));
}

template <int D>
typename CellGrid<D>::Block CellGrid<D>::about(const IntVec<D>& cell, int reach) {
  return {cell - IntVec<D>::Constant(reach), cell + IntVec<D>::Constant(reach)};
}

// The cells about `cell` whose number along an axis is `at`.
template <int D>
typename CellGrid<D>::Block CellGrid<D>::row(const IntVec<D>& cell, int axis, int at, int reach) {
  Block block = about(cell, reach);
  block.from[axis] = block.to[axis] = at;
  return block;
}

// Calls visit(list, wrap) for the list of each cell of a block. `wrap` is the periodic image of a
// particle within the box, seen from that cell.
template <int D>
template <int Axis, typename Visit>
[[gnu::always_inline]] inline void CellGrid<D>::visit_lists(const Block& block, std::uint32_t index,
                                                            Neighbour wrap, const Visit& visit,
                                                            int slid) const {
  for (int k = block.from[Axis]; k <= block.to[Axis]; ++k) {
    if (Axis == 0 && slides_) [[unlikely]] {
      // Seen from a row that has slid, a particle is some boxes to the left or right.
      const int at = within_row(k + slid), boxes = (at - (k + slid)) / counts_[0];
      const Neighbour bits = static_cast<Neighbour>(boxes) & 3u;
      visit(index + static_cast<std::uint32_t>(at), wrap | bits << kParticleBits<D>);
      continue;
    }
    const Place& place = places_[Axis][static_cast<std::size_t>(k + margin_)];
    if (place.index == kNone) continue;
    if constexpr (Axis == 0) {
      visit(index + place.index, wrap | place.wrap);
    } else {
      if (Axis == 1 && slides_) slid = k < 0 ? slid_ : k >= counts_[1] ? -slid_ : 0;
      visit_lists<Axis - 1>(block, index + place.index, wrap | place.wrap, visit, slid);
    }
  }
}

template <int D>
template <typename Visit>
void CellGrid<D>::visit_moved(const IntVec<D>& cell, int axis, int step, const Visit& visit) const {
  const IntVec<D> next = neighbour(cell, axis, step);
  const auto visit_list = [&](std::uint32_t list, Neighbour) { visit(lists_[list]); };
  visit_lists<D - 1>(row(cell, axis, cell[axis] - step), 0, 0, visit_list);
  visit_lists<D - 1>(row(cell, axis, next[axis] + step), 0, 0, visit_list);
}

// The lists begin at one cell from the lower end of the reach, and end at one cell from its upper
// end or beyond. Where there are no cells, the list of the nearest cell serves.
template <int D>
template <typename Visit>
void CellGrid<D>::visit_wide(const IntVec<D>& cell, int reach, const Visit& visit) const {
  const int lists = lists_along(reach);
  IntVec<D> number = IntVec<D>::Zero();
  while (number[D - 1] < lists) {
    IntVec<D> at, wrap = IntVec<D>::Zero();
    bool exists = true;
    for (int axis = 0; axis < D; ++axis) {
      const int count = counts_[axis];
      at[axis] = cell[axis] - (reach - 1) + 3 * number[axis];
      if (at[axis] >= 0 && at[axis] < count) continue;
      const bool upper = at[axis] >= count;
      if (subdomain_.ends[static_cast<std::size_t>(2 * axis)] == End::Periodic) {
        wrap[axis] = upper ? 1 : -1;
        at[axis] -= wrap[axis] * count;
      } else {
        exists = exists && at[axis] >= -1 && at[axis] <= count;
        at[axis] = upper ? count - 1 : 0;
      }
    }
    if (exists) visit(lists_[index(at)], wrap);
    for (int axis = 0; ++number[axis] == lists && axis < D - 1; ++axis) number[axis] = 0;
  }
}

// A particle on a parabola may leave through the border by which it entered. The calculation starts
// at the current position: unlike a contact time, a crossing time need not be a function of the
// stored state alone.
template <int D>
[[gnu::always_inline]] inline Exit CellGrid<D>::exit_falling(const Model<D>& model,
                                                             const Flight<D>& flight,
                                                             const Vec<D>& image,
                                                             const IntVec<D>& cell, int axis,
                                                             double now) const {
  const double a = model.gravity[axis];
  const double since = now - flight.time;
  const double r =
      flight.r[axis] + (flight.v[axis] + a * (0.5 * since)) * since - image[axis] * model.box[axis];
  const double v = flight.v[axis] + a * since;
  const double lower = border(axis, cell[axis], false);
  const double upper = border(axis, cell[axis], true);
  const WayOut out = exit_time(r - lower, upper - r, v, a);
  double time = now + out.time;
  // A particle that turns just beyond a border returns later, at least by the smallest time step.
  if (time == now && (v < 0.0) == out.upper) [[unlikely]]
    time = std::nextafter(now, kNever);
  return {time, border_of(axis, out.upper)};
}

// Branch-free, because the signs of the velocity are unpredictable.
template <int D>
template <bool kFalling>
[[gnu::always_inline]] inline std::array<Exit, D> CellGrid<D>::exits(const Model<D>& model,
                                                                     const Flight<D>& flight,
                                                                     const Vec<D>& image,
                                                                     const IntVec<D>& cell,
                                                                     double now) const {
  std::array<bool, D> upper;
  Vec<D> place;
  for (int axis = 0; axis < D; ++axis) {
    upper[axis] = flight.v[axis] >= 0.0;
    place[axis] = border(axis, cell[axis], upper[axis]);
  }
  const Vec<D> way = place + image.cwiseProduct(model.box) - flight.r;
  // v + 0.0 turns -0 into +0: a particle at rest reaches its upper border at time infinity.
  const Vec<D> time = flight.time + way.array() / (flight.v.array() + 0.0);
  std::array<Exit, D> exits;
  for (int axis = 0; axis < D; ++axis) {
    if (kFalling && model.gravity[axis] != 0.0) {
      exits[axis] = exit_falling(model, flight, image, cell, axis, now);
    } else {
      exits[axis] = {std::max(now, time[axis]), border_of(axis, upper[axis])};
    }
  }
  return exits;
}

// By components: they are read from memory, and a vector of them would first be written there.
template <int D>
[[gnu::always_inline]] inline std::array<Exit, D> CellGrid<D>::flow_exits(const Domain<D>& domain,
                                                                          const Flight<D>& flight,
                                                                          const Vec<D>& image,
                                                                          const IntVec<D>& cell,
                                                                          double now) const {
  std::array<Exit, D> exits;
  for (int axis = 1; axis < D; ++axis) {
    const bool upper = flight.v[axis] >= 0.0;
    const double way =
        border(axis, cell[axis], upper) + image[axis] * domain.box[axis] - flight.r[axis];
    exits[axis] = {std::max(now, flight.time + way / (flight.v[axis] + 0.0)),
                   border_of(axis, upper)};
  }
  // Along x the cells move: x - s y is a parabola in time.
  const double since = now - flight.time, strain = strain_at(now);
  const double y = flight.r[1] - image[1] * domain.box[1] + flight.v[1] * since - middle();
  const double slide = domain.velocity_x(image);
  const double shift = image[0] * domain.box[0] + image[1] * domain.offset + slide * flight.time;
  const double v = flight.v[0] - slide;
  const double x = flight.r[0] - shift + v * since - strain * y;
  const double speed = v - strain * flight.v[1] - strain_rate_ * y;
  const double lower = border(0, cell[0], false), upper = border(0, cell[0], true);
  const WayOut out = exit_time(x - lower, upper - x, speed, -2.0 * strain_rate_ * flight.v[1]);
  double time = now + out.time;
  if (time == now && (speed < 0.0) == out.upper) [[unlikely]]
    time = std::nextafter(now, kNever);
  exits[0] = {time, border_of(0, out.upper)};
  return exits;
}

extern template class CellGrid<2>;
extern template class CellGrid<3>;

}  // namespace clatter
