#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "engine/dynamics/cell_grid.h"
#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/neighbour_lists.h"
#include "engine/dynamics/particle.h"
#include "engine/dynamics/piece_lists.h"
#include "engine/dynamics/prefetch.h"
#include "engine/physics/theory.h"

// Near particles are in lists (Neighbourhood). The list of a cell holds the particles of the cell
// and of all neighbouring cells (CellGrid). A particle changes cells only when it is beyond the
// border by an overhang, which is as wide as contacts allow. This hysteresis prevents repeated
// crossings. Cells become finer in clusters. Spheres above a volume fraction of 0.43 have lists of
// their own (NeighbourLists). In a mixture the fraction is that of as many spheres that are as wide
// as the cells, and no diameter may be below half of the largest. With fixtures there are cells
// alone, because these have the lists of their pieces. Lists of spheres have half as many
// particles as those of 27 cells, and dense spheres leave their regions rarely.

namespace clatter {

/// Finds the particles near a particle, by lists of cells or of particles. The choice affects speed
/// only. Dense spheres fly short ways, so lists of particles change rarely, and they are shorter
/// than lists of 27 cells. Lists of 9 cells are the fastest for disks at any density.
template <int D>
class Neighbourhood {
 public:
  /// A neighbourhood for a number of particles. `grains` are those of a mixture, empty if all are
  /// alike, and must outlive it.
  Neighbourhood(const Model<D>& model, const GrainArray& grains, double particles)
      : grains_(&grains),
        grid_(
            whole_box<D>(model), grid_sizes<D>(model, grains),
            has_lists(model, grains, particles) ? 1.0 : CellGrid<D>::kCellsPerParticle * particles),
        pieces_(model) {
    if (has_lists(model, grains, particles)) lists_.emplace(model, grains, particles);
    pieces_.lay(grid_);
  }

  /// Empties the neighbourhood and lays cells for a number of particles over a subdomain. `sizes`
  /// are those of their grid_sizes(), and the fixtures those of `model`.
  void reset(const Model<D>& model, const Subdomain<D>& subdomain, const GridSizes& sizes,
             double particles) {
    lists_.reset();
    grid_.reset(subdomain, sizes, CellGrid<D>::kCellsPerParticle * particles);
    set_fixtures(model);
  }

  /// Whether a particle reads several lists, see visit_wide().
  bool is_wide(std::uint32_t particle) const { return reach_of(particle) > 1; }
  /// As CellGrid::visit_wide. For particles that read several lists.
  template <typename Visit>
  void visit_wide(std::uint32_t particle, const IntVec<D>& cell, const Visit& visit) const {
    grid_.visit_wide(cell, reach_of(particle), visit);
  }

  /// The largest and the least capacity of a list. Lists of particles exist in 3D only.
  static constexpr int kCapacity = CellGrid<D>::kCapacity;
  static constexpr int kLeastCapacity = D == 2 ? kCapacity : NeighbourLists<D>::kCapacity;
  static_assert(kLeastCapacity <= kCapacity);

  /// Puts a particle at a position inside the box. Returns its cell.
  IntVec<D> place(std::uint32_t particle, const Vec<D>& position) {
    const IntVec<D> cell = grid_.cell_at(position);
    if (by_particle()) {
      lists_->place(particle, position);
    } else {
      grid_.insert(particle, cell, reach_of(particle));
    }
    return cell;
  }
  /// The cell of a position. For cells only, not for lists of particles.
  IntVec<D> cell_at(const Vec<D>& position) const { return grid_.cell_at(position); }
  /// As CellGrid::fill, for particles that are alike. For cells only.
  void fill(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order) {
    grid_.fill(cells, order);
  }
  /// As CellGrid::sort. For cells only.
  void sort(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order) const {
    grid_.sort(cells, order);
  }
  /// Puts a particle into a cell. For cells only.
  void insert(std::uint32_t particle, const IntVec<D>& cell) {
    grid_.insert(particle, cell, reach_of(particle));
  }
  /// Adapts the number of cells to the crowding, from the plans of all particles. Returns whether
  /// the grid is now empty.
  template <typename Plans>
  bool fit(const Plans& plans) {
    if (by_particle()) return false;
    double near = 0.0;
    for (const auto& plan : plans) {
      near += static_cast<double>(grid_.continuations().count(grid_.near(plan.cell)));
    }
    const bool changed = grid_.fit(static_cast<double>(plans.size()), near);
    if (changed) pieces_.lay(grid_);
    return changed;
  }

  /// Takes the changed fixtures of a model.
  void set_fixtures(const Model<D>& model) {
    if (model.fixtures.empty()) return;
    pieces_ = PieceLists<D>(model);
    pieces_.lay(grid_);
  }
  /// Whether there are fixtures.
  bool has_pieces() const { return pieces_.any(); }
  /// The pieces of fixtures that a particle in a cell may touch.
  std::span<const typename PieceLists<D>::Entry> pieces_near(const IntVec<D>& cell) const {
    return pieces_.near(grid_.number_of(cell));
  }
  /// A piece of a fixture, by its number in Event::partner.
  const typename PieceLists<D>::Owned& piece(std::uint32_t number) const {
    return pieces_.piece(number);
  }

  /// The first list of the particles near a particle in a cell.
  NearListView near(std::uint32_t particle, const IntVec<D>& cell) const {
    return by_particle() ? NearListView(lists_->near(particle)) : NearListView(grid_.near(cell));
  }
  /// The list that continues a list, which must not be the last.
  NearListView next(const NearListView& list) const {
    return by_particle() ? lists_->continuations().next(list) : grid_.continuations().next(list);
  }
  /// Calls visit(particle, wrap) for each particle that may touch a particle in a cell, at least
  /// once. `wrap` is its periodic image in box lengths.
  template <typename Visit>
  void visit(std::uint32_t particle, const IntVec<D>& cell, const Visit& visit) const {
    if (by_particle()) {
      lists_->continuations().visit(lists_->near(particle), visit);
    } else if (is_wide(particle)) {
      grid_.visit_wide(cell, reach_of(particle), [&](const auto& list, const IntVec<D>& image) {
        grid_.continuations().visit(list, [&](std::uint32_t neighbour, const Vec<D>& wrap) {
          visit(neighbour, Vec<D>(wrap + image.template cast<double>()));
        });
      });
    } else {
      grid_.visit(cell, visit);
    }
  }

  /// Least distance of a particle in a cell from the lower or upper end of the box.
  double distance_from_end(std::uint32_t particle, const IntVec<D>& cell, int axis,
                           bool upper) const {
    return by_particle() ? lists_->distance_from_end(particle, axis, upper)
                         : grid_.distance_from_end(cell, axis, upper);
  }
  /// The exits of a particle from its cell or region.
  template <bool kFalling>
  [[gnu::always_inline]] std::array<Exit, D> exits(const Model<D>& model,
                                                   const ParticleArray<D>& particles,
                                                   std::uint32_t number, const IntVec<D>& cell,
                                                   double now) const {
    const Flight<D>& flight = particles[number].flight;
    const Vec<D> image = particles.image(number);
    if (!by_particle()) return grid_.template exits<kFalling>(model, flight, image, cell, now);
    std::array<Exit, D> exits;
    exits.fill({kNever, kCellBorder});
    exits[0] = lists_->template exit<kFalling>(model, flight, image, number, now);
    return exits;
  }
  /// Chooses the strain of the cells of a sheared box at the time `now`. The cells must be empty.
  void lay_with_flow(const Domain<D>& domain, double now) { grid_.lay_with_flow(domain, now); }
  /// Removes all particles. For cells only.
  void clear() { grid_.clear(); }
  /// Time at which the strain of the cells is largest; kNever: it is constant.
  double flow_ends() const { return grid_.flow_ends(); }
  /// The place of a position in the cells of a sheared box at a time.
  Vec<D> with_flow(const Vec<D>& position, double time) const {
    return grid_.with_flow(position, time);
  }
  /// Box lengths along x by which the next image above has slid, beside the wraps of neighbours.
  int boxes_slid() const { return grid_.boxes_slid(); }
  /// The exits of a particle from its cell in a sheared box, one along each axis. The domain has
  /// the offset of time 0.
  [[gnu::always_inline]] std::array<Exit, D> flow_exits(const Domain<D>& domain,
                                                        const ParticleArray<D>& particles,
                                                        std::uint32_t number, const IntVec<D>& cell,
                                                        double now) const {
    return grid_.flow_exits(domain, particles[number].flight, particles.image(number), cell, now);
  }
  /// Whether a particle that crosses a border of its cell leaves all cells.
  bool leaves_all(const IntVec<D>& cell, std::uint32_t border) const {
    return !by_particle() && grid_.leaves_subdomain(cell, border);
  }
  /// Removes a particle from its cell.
  void remove(std::uint32_t particle, const IntVec<D>& cell) {
    grid_.remove(particle, cell, reach_of(particle));
  }
  /// Moves a particle to its next cell or region. Returns its shift to another periodic image, in
  /// box lengths.
  Vec<D> leave(const Model<D>& model, const ParticleArray<D>& particles, std::uint32_t number,
               IntVec<D>& cell, std::uint32_t border, double now) {
    if (!by_particle()) return grid_.leave(number, cell, border, reach_of(number));
    return lists_->leave(model, particles[number].flight, particles.image(number), number, now);
  }

  /// Prefetches the first list near a particle in a cell.
  void prefetch_near(std::uint32_t particle, const IntVec<D>& cell) const {
    if (by_particle()) {
      prefetch(lists_->near(particle));
    } else {
      prefetch(grid_.near(cell));
    }
  }
  /// Prefetches the lists that a crossing changes.
  void prefetch_crossing(const IntVec<D>& cell, std::uint32_t border) const {
    if (by_particle()) return;
    const auto [axis, step] = crossing_of(border);
    grid_.visit_moved(cell, axis, step, [](const auto& list) { prefetch(list); });
  }
  /// Prefetches the data that a new region of a particle needs.
  void prefetch_search(std::uint32_t particle) const {
    if (by_particle()) lists_->prefetch_search(particle);
  }
  /// The cell of a particle after a crossing.
  IntVec<D> cell_after(const IntVec<D>& cell, std::uint32_t border) const {
    if (by_particle()) return cell;
    const auto [axis, step] = crossing_of(border);
    return grid_.neighbour(cell, axis, step);
  }

 private:
  // Measured for N = 10,976: from this volume fraction on, lists of particles are faster.
  static constexpr double kDense = 0.43;
  // Whether the particles have lists of their own.
  static bool has_lists(const Model<D>& model, const GrainArray& grains, double particles) {
    if (!model.fixtures.empty() || model.shear_rate) return false;
    for (int axis = 0; axis < D; ++axis) {
      const double narrowest = NeighbourLists<D>::kMinSide * model.diameter;
      if (model.periodic(axis) && model.box[axis] < narrowest) return false;
    }
    if (D == 2) return false;
    constexpr double kAlike = 2.0;  // ratio of the largest to the least diameter
    bool similar = true;
    grains.for_each([&](const Grain& grain) {
      similar = similar && kAlike * 2.0 * grain.radius >= model.diameter;
    });
    if (!similar) return false;
    // Lists of cells are as long as those of a gas of particles that are as wide as the cells.
    const double volume = particles * std::pow(grid_sizes<D>(model, grains).base, D);  // of cubes
    return packing_fraction(D, volume / model.box.prod()) > kDense;
  }
  bool by_particle() const { return D == 3 && lists_.has_value(); }

  int reach_of(std::uint32_t particle) const {
    return grid_.has_wide() ? grid_.reach_of(2.0 * grains_->radius(particle)) : 1;
  }

  const GrainArray* grains_;  // a pointer, so that a neighbourhood can be assigned
  CellGrid<D> grid_;          // of one cell beside lists of particles
  std::optional<NeighbourLists<D>> lists_;
  PieceLists<D> pieces_;
};

}  // namespace clatter
