#pragma once

#include <array>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// Integrals over time and cell of what the disks in it carry: each free flight is cut at the cell
/// borders and counts the time spent in each cell, times 1, v_k and v_k^2 (the track-length
/// estimator). With a window Dt and cell area A, density is count/(Dt A).
template <int D>
struct CellMoments {
  double count = 0.0;                        ///< integral of the number of disks
  Vec<D> velocity = Vec<D>::Zero();          ///< integral of sum v_k
  Vec<D> velocity_squared = Vec<D>::Zero();  ///< integral of sum v_k^2

  CellMoments& operator+=(const CellMoments& other);
};

template <class Archive, int D>
void visit(Archive& io, CellMoments<D>& moments) {
  auto& [count, velocity, velocity_squared] = moments;
  io(count, velocity, velocity_squared);
}

/// Accumulates CellMoments on a grid of equal cells over the whole box.
template <int D>
class CellIntegrals : public Observer<D> {
 public:
  /// Watches a simulation from now on with the given number of cells along each axis.
  CellIntegrals(const Simulation<D>& simulation, const IntVec<D>& cells);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;

  /// The integrals since the last call, or since the start; cell (i, j) at index i + j cells.x().
  std::vector<CellMoments<D>> close_window();

  /// Number of cells along each axis.
  const IntVec<D>& cells() const { return cells_; }

  /// What a checkpoint keeps, of a simulation that goes on at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, cells, widths, window_start, moments] = *this;
    io(window_start, moments);
  }

 private:
  /// A flight's way out of a cell.
  struct Crossing {
    double time = kNever;
    int axis = 0;
    int step = 0;  // +1 or -1
  };

  Crossing next_crossing(const Flight<D>& flight, const std::array<long, D>& cell,
                         double time) const;
  std::size_t index_of(const std::array<long, D>& cell) const;
  void add_flight(const Flight<D>& flight, double end);

  const Simulation<D>& simulation_;
  IntVec<D> cells_;
  Vec<D> widths_;
  double window_start_;
  std::vector<CellMoments<D>> moments_;
};

extern template class CellIntegrals<2>;

}  // namespace clatter
