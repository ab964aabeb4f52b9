#include "engine/measure/cell_integrals.h"

#include <algorithm>
#include <cmath>

#include "engine/physics/fall_time.h"

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
  const Vec<D>& gravity = simulation_.model().gravity;
  double time = std::max(flight.time, window_start_);
  if (!(end > time)) return;
  std::array<long, D> cell;
  const Vec<D> from = flight.at(time, gravity);
  for (int axis = 0; axis < D; ++axis) {
    cell[axis] = static_cast<long>(std::floor(from[axis] / widths_[axis]));
  }
  while (time < end) {
    const Crossing next = next_crossing(flight, cell, time);
    const double until = std::min(next.time, end);
    const double spent = until - time;
    const Vec<D> v = flight.velocity_at(time, gravity);
    CellMoments<D>& moments = moments_[index_of(cell)];
    moments.count += spent;
    moments.velocity += spent * (v + 0.5 * spent * gravity);
    moments.velocity_squared +=
        spent *
        (v.cwiseAbs2() + spent * (v.cwiseProduct(gravity) + spent / 3.0 * gravity.cwiseAbs2()));
    time = until;
    cell[next.axis] += next.step;
  }
}

// Along each axis a straight flight has one border ahead, a parabola may return to the one behind.
template <int D>
typename CellIntegrals<D>::Crossing CellIntegrals<D>::next_crossing(const Flight<D>& flight,
                                                                    const std::array<long, D>& cell,
                                                                    double time) const {
  const Vec<D>& gravity = simulation_.model().gravity;
  const Vec<D> r = flight.at(time, gravity);
  const Vec<D> v = flight.velocity_at(time, gravity);
  Crossing next;
  for (int axis = 0; axis < D; ++axis) {
    for (const int step : {-1, 1}) {
      const double border = static_cast<double>(cell[axis] + (step > 0)) * widths_[axis];
      const double crossing =
          time + fall_time(step * (border - r[axis]), -step * v[axis], -step * gravity[axis]);
      if (crossing < next.time) next = {crossing, axis, step};
    }
  }
  return next;
}

template <int D>
std::size_t CellIntegrals<D>::index_of(const std::array<long, D>& cell) const {
  std::size_t index = 0;
  for (int k = D - 1; k >= 0; --k) {
    const long n = cells_[k];
    const long folded =
        simulation_.model().periodic(k) ? ((cell[k] % n) + n) % n : std::clamp(cell[k], 0L, n - 1);
    index = index * static_cast<std::size_t>(n) + static_cast<std::size_t>(folded);
  }
  return index;
}

template <int D>
void CellIntegrals<D>::on_collision(const PairCollision<D>& collision) {
  for (const DiskChange<D>& disk : collision.disks) add_flight(disk.before, collision.time);
}

template <int D>
void CellIntegrals<D>::on_wall(const WallCollision<D>& collision) {
  add_flight(collision.disk.before, collision.time);
}

template <int D>
void CellIntegrals<D>::on_kick(const Kick<D>& kick) {
  add_flight(kick.disk.before, kick.time);
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
