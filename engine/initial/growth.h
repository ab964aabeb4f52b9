#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/cell_of.h"
#include "engine/laws/domain.h"
#include "engine/physics/lattice.h"
#include "engine/physics/random.h"
#include "engine/stop_request.h"
#include "engine/vec.h"

namespace clatter {

/// Random places of many particles that are alike, without overlaps, in parts. The room is cut into
/// blocks. The numbers of their particles are random, with the variance of an elastic gas in
/// equilibrium. Smaller particles are inserted at random in each block, then they grow to their
/// diameter at once. Each overlapping pair moves apart along the line of its centres, by a random
/// distance beyond contact, until no particles overlap. Only particles that have moved are looked
/// at again, so the work grows as their number.
template <int D>
class Growth {
 public:
  /// Begins with an empty room. `random` must outlive the growth.
  Growth(const Room<D>& room, int count, Random& random);

  /// Continues until no particles overlap, or until the overlaps no longer end. Returns false at a
  /// request to pause; the pauses do not change the result.
  bool advance(const StopRequest& pause = {});
  /// Estimate of the completed part, 0..1.
  double progress() const;
  /// [count] the places; empty if particles overlap. None remain.
  std::vector<Vec<D>> take();

 private:
  /// Cells, and the number of particles that are inserted in them.
  struct Block {
    IntVec<D> first, last;  ///< cells along each axis, without the last
    int missing = 0;
  };

  void make_blocks(double fraction);
  bool insert(const StopRequest& pause);
  void try_in(Block& block);
  void sort_by_cell();
  bool part_pairs(const StopRequest& pause);
  void part_from_others(std::uint32_t particle);
  void move(std::uint32_t particle, const Vec<D>& way);
  template <class Visit>
  void visit_near(const Vec<D>& place, const Visit& visit) const;
  IntVec<D> cell_at(const Vec<D>& place) const {
    return cell_of<D>(place - low_, widths_, counts_);
  }
  std::uint32_t index_of(const IntVec<D>& cell) const;

  static constexpr std::uint32_t kNone = 0xffffffffu;

  Domain<D> domain_;
  std::size_t count_;
  Random& random_;
  double diameter_;
  double inserted_diameter_;
  double most_gap_;    // between two particles that have moved apart
  Vec<D> low_, high_;  // limits of centres
  IntVec<D> counts_;   // of cells along each axis: one, or each wider than the diameter
  Vec<D> widths_;
  std::array<std::uint32_t, D == 2 ? 9 : 27> steps_;  // from a cell to it and the adjacent ones
  bool is_narrow_ = false;            // whether two images of a cell are neighbours of a third one
  std::vector<Vec<D>> places_;        // [N]
  std::vector<std::uint32_t> heads_;  // [cells] the first particle, or kNone
  std::vector<std::uint32_t> next_;   // [N] the next particle of the same cell, or kNone
  std::vector<Block> blocks_;
  std::size_t next_block_ = 0;  // of the present sweep
  bool inserted_ = false;
  std::vector<std::uint32_t> pass_;      // particles that may overlap others, in this pass
  std::vector<std::uint32_t> moved_;     // the same in the next pass
  std::vector<std::uint8_t> has_moved_;  // [N] whether a particle is in moved_
  std::size_t looked_at_ = 0;            // particles of this pass
  int passes_ = 0;
};

extern template class Growth<2>;
extern template class Growth<3>;

}  // namespace clatter
