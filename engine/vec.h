#pragma once

#include <Eigen/Core>
#include <vector>

namespace clatter {

/// A position, velocity or extent in D dimensions.
template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

/// Integers along each of D dimensions: a cell, a periodic image or counts.
template <int D>
using IntVec = Eigen::Matrix<int, D, 1>;

using Vec2 = Vec<2>;

/// The direction of the first axis. A product with it stays in a vector register: a processor waits
/// for a vector of which one component was written on its own. Not for initialisers of static data.
template <int D>
inline const Vec<D> kAlongX = Vec<D>::Unit(0);

/// A vector of two or three components: the dimension of the scene.
using VecX = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;

/// [D][N] vectors of two or three components, one per column.
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3>;

/// The vectors of a list as columns.
template <int D>
Vectors as_columns(const std::vector<Vec<D>>& vectors) {
  using Columns = Eigen::Matrix<double, D, Eigen::Dynamic>;
  const double* first = vectors.empty() ? nullptr : vectors.front().data();
  return Eigen::Map<const Columns>(first, D, static_cast<Eigen::Index>(vectors.size()));
}

}  // namespace clatter
