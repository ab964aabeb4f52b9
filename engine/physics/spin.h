#pragma once

#include "engine/vec.h"

namespace clatter {

/// Angular velocity of a disk (one number) or of a sphere (a vector).
template <int D>
using Spin = Eigen::Matrix<double, D*(D - 1) / 2, 1>;

}  // namespace clatter
