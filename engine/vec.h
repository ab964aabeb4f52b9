#pragma once

#include <Eigen/Core>

namespace clatter {

/// A position, velocity or extent in D dimensions.
template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

/// A cell, an image or a count along each of D dimensions.
template <int D>
using IntVec = Eigen::Matrix<int, D, 1>;

using Vec2 = Vec<2>;

/// A vector of two or three components, as many as the scene has dimensions.
using VecX = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;

}  // namespace clatter
