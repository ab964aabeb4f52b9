#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/measure/field_grid.h"

namespace clatter {

/// The smooth coarse-graining function Phi(r) = exp(-r^2/2w^2)/(2 pi w^2)^(D/2), evaluated at the
/// centres of a grid's cells and multiplied by their measure. It continues across periodic borders;
/// at walls it is cut off without renormalisation. Values beyond 6 w are neglected; in 2D they are
/// 1.5e-8 of the integral.
template <int D>
class GaussianKernel {
 public:
  /// Kernel of width w on the cells of `grid`.
  GaussianKernel(const FieldGrid<D>& grid, double width) : grid_(grid), width_(width) {}

  /// Calls visit(index, weight) with Phi(r - place) for every cell in reach.
  template <class Visit>
  void at(const Vec<D>& place, Visit&& visit) const {
    const double scale = normalisation();
    in_reach(place, place, [&](const Vec<D>& r, std::size_t index) {
      visit(index, scale * std::exp(-(r - place).squaredNorm() / (2.0 * width_ * width_)));
    });
  }

  /// The same with the mean of Phi over the line from `from` to `from + along`, which is B in
  /// closed form (theory 8.12).
  template <class Visit>
  void along(const Vec<D>& from, const Vec<D>& along, Visit&& visit) const {
    const double length = along.norm();
    const Vec<D> u = along / length;
    const double per_width = 1.0 / (std::numbers::sqrt2 * width_);
    const double scale = normalisation() * width_ * std::sqrt(0.5 * std::numbers::pi) / length;
    in_reach(from, from + along, [&](const Vec<D>& r, std::size_t index) {
      const double ahead = u.dot(r - from);
      const double aside = (r - from - ahead * u).norm() * per_width;
      visit(index, scale * std::exp(-aside * aside) *
                       (std::erf(ahead * per_width) - std::erf((ahead - length) * per_width)));
    });
  }

 private:
  static constexpr double kReach = 6.0;

  double normalisation() const {
    return grid_.cell_measure() *
           std::pow(2.0 * std::numbers::pi * width_ * width_, -0.5 * static_cast<double>(D));
  }

  /// Calls visit(centre, index) for the cells within reach of the rectangle (in 3D cuboid) between
  /// two corners.
  template <class Visit>
  void in_reach(const Vec<D>& a, const Vec<D>& b, Visit&& visit) const {
    const Vec<D> reach = Vec<D>::Constant(kReach * width_);
    typename FieldGrid<D>::Cell low = grid_.cell_at(a.cwiseMin(b) - reach);
    typename FieldGrid<D>::Cell high = grid_.cell_at(a.cwiseMax(b) + reach);
    for (int axis = 0; axis < D; ++axis) {
      if (grid_.periodic(axis)) continue;
      low[axis] = std::max<std::int64_t>(low[axis], 0);
      high[axis] = std::min<std::int64_t>(high[axis], grid_.cells()[axis] - 1);
    }
    for (typename FieldGrid<D>::Cell cell = low; cell[D - 1] <= high[D - 1];) {
      visit(grid_.centre_of(cell), grid_.index_of(cell));
      ++cell[0];
      for (int axis = 0; axis + 1 < D && cell[axis] > high[axis]; ++axis) {
        cell[axis] = low[axis];
        ++cell[axis + 1];
      }
    }
  }

  FieldGrid<D> grid_;
  double width_;
};

}  // namespace clatter
