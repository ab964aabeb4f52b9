#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/vec.h"

namespace clatter {

/// The shade of a sphere by its neighbours, to second order in the normal n of its surface.
///
/// A neighbour of radius r in the direction u covers a share w max(0, n u) of the sky over n, with
/// w = 2 (r/s)^2 at a distance s of the centres. On a smaller sphere of radius q it is w = (1 +
/// q/r) (r/s)^2: all of the sky where a huge one touches. The expansion of max(0, c) in Legendre
/// polynomials, 1/4 + c/2 + 5 (3 c^2 - 1)/32, needs three moments of the neighbours:
///   covered = 3/32 weight + direction n / 2 + 15/32 n second n.
struct NeighbourShade {
  float weight = 0.0f;                                  ///< sum of w
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< sum of w u
  Eigen::Vector3f squares = Eigen::Vector3f::Zero();    ///< sum of w u_k u_k: xx, yy, zz
  Eigen::Vector3f products = Eigen::Vector3f::Zero();   ///< sum of w u_k u_l: xy, xz, yz
};

/// The shades of the spheres with the numbers `wanted`, by all spheres with these centres and
/// radii. The radii are one of each sphere, or one for all. Neighbours with a gap of more than 0.75
/// of their diameters do not count.
std::vector<NeighbourShade> neighbour_shades(std::span<const Vec<3>> centres,
                                             std::span<const double> radii,
                                             std::span<const std::uint32_t> wanted);

}  // namespace clatter
