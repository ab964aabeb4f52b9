#pragma once

#include <stdexcept>
#include <type_traits>
#include <utility>

namespace clatter {

/// Calls function(std::integral_constant<int, D>) for the dimension D of a scene, 2 or 3. Only this
/// function selects the types of disks or spheres at run time.
template <class Function>
decltype(auto) with_dimension(int dimension, Function&& function) {
  switch (dimension) {
    case 2:
      return std::forward<Function>(function)(std::integral_constant<int, 2>{});
    case 3:
      return std::forward<Function>(function)(std::integral_constant<int, 3>{});
  }
  throw std::logic_error("a scene has two or three dimensions");
}

}  // namespace clatter
