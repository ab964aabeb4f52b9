#pragma once

#include <stdexcept>
#include <type_traits>
#include <utility>

namespace clatter {

/// Calls function(std::integral_constant<int, D>) for the dimension D that a scene has, 2 or 3: the
/// one place where a number known at run time chooses the types of disks or of spheres.
template <class Function>
decltype(auto) with_dimension(int dimension, Function&& function) {
  switch (dimension) {
    case 2:
      return std::forward<Function>(function)(std::integral_constant<int, 2>{});
    case 3:
      return std::forward<Function>(function)(std::integral_constant<int, 3>{});
  }
  throw std::logic_error("there are scenes of two and of three dimensions only");
}

}  // namespace clatter
