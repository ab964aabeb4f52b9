#pragma once

#include <doctest/doctest.h>

#include <type_traits>

namespace clatter::testing {

/// Dimensions of templated cases.
using Plane = std::integral_constant<int, 2>;
using Space = std::integral_constant<int, 3>;

}  // namespace clatter::testing

TYPE_TO_STRING_AS("2D", clatter::testing::Plane);
TYPE_TO_STRING_AS("3D", clatter::testing::Space);
