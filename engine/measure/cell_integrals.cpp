#include "engine/measure/cell_integrals.h"

#include <algorithm>
#include <cmath>

namespace clatter {

template <int D>
CellMoments<D>& CellMoments<D>::operator+=(const CellMoments& other) {
  count += other.count;
  velocity += other.velocity;
  velocity_squared += other.velocity_squared;
  return *this;
}

template <int D>
CellIntegrals<D>::CellIntegrals(const Simulation<D>& simulation, const IntVec<D>& cells)
    : simulation_(simulation),
      cells_(cells),
      widths_(simulation.model().box.cwiseQuotient(cells.template cast<double>())),
      window_start_(simulation.base_time()),
      moments_(static_cast<std::size_t>(cells.prod())) {}

// Walks the flight from border to border. Cells are counted on without end along periodic axes and
// folded back into the box; along walled ones the edge cells take what lies beyond.
template <int D>
void CellIntegrals<D>::add_flight(const Flight<D>& flight, double end) {
  double time = std::max(flight.time, window_start_);
  if (!(end > time)) return;
  const Vec<D>& v = flight.v;
  const Vec<D> v_squared = v.cwiseAbs2();
  const Vec<D> from = flight.at(time);
  std::array<double, D> next;  // time of the next border along each axis
  std::array<long, D> cell;
  const auto border_time = [&](int axis) {
    const long border = cell[axis] + (v[axis] > 0.0);
    return flight.time + (static_cast<double>(border) * widths_[axis] - flight.r[axis]) / v[axis];
  };
  for (int axis = 0; axis < D; ++axis) {
    cell[axis] = static_cast<long>(std::floor(from[axis] / widths_[axis]));
    next[axis] = v[axis] == 0.0 ? kNever : border_time(axis);
  }
  for (;;) {
    const int axis = static_cast<int>(std::min_element(next.begin(), next.end()) - next.begin());
    const double until = std::min(std::max(next[axis], time), end);
    std::size_t index = 0;
    for (int k = D - 1; k >= 0; --k) {
      const long n = cells_[k];
      const long folded = simulation_.model().periodic(k) ? ((cell[k] % n) + n) % n
                                                          : std::clamp(cell[k], 0L, n - 1);
      index = index * static_cast<std::size_t>(n) + static_cast<std::size_t>(folded);
    }
    const double spent = until - time;
    CellMoments<D>& moments = moments_[index];
    moments.count += spent;
    moments.velocity += v * spent;
    moments.velocity_squared += v_squared * spent;
    if (next[axis] >= end) return;
    time = until;
    cell[axis] += v[axis] > 0.0 ? 1 : -1;
    next[axis] = border_time(axis);
  }
}

template <int D>
void CellIntegrals<D>::on_collision(const PairCollision<D>& collision) {
  for (const Flight<D>& flight : collision.before) add_flight(flight, collision.time);
}

template <int D>
void CellIntegrals<D>::on_wall(const WallCollision<D>& collision) {
  add_flight(collision.before, collision.time);
}

template <int D>
void CellIntegrals<D>::on_base_moved(double shift) {
  window_start_ -= shift;
}

template <int D>
std::vector<CellMoments<D>> CellIntegrals<D>::close_window() {
  const double now = simulation_.base_time();
  for (const Disk<D>& disk : simulation_.disks()) add_flight(disk.flight, now);
  window_start_ = now;
  std::vector<CellMoments<D>> closed(moments_.size());
  closed.swap(moments_);
  return closed;
}

template struct CellMoments<2>;
template class CellIntegrals<2>;

}  // namespace clatter
