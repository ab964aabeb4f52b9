#pragma once

// Parts of C++20 that the standard library of an older emscripten lacks, from the libraries
// range-v3, fast_float and fmt. Every source of the page includes this file first. libc++ 13
// (emscripten 3.1.6) needs all parts, libc++ 18 (3.1.69) from_chars alone, and libc++ 20 none.

#include <version>

#ifndef __cpp_lib_ranges

#include <algorithm>
#include <range/v3/algorithm.hpp>

namespace std::ranges {
using ::ranges::adjacent_find;
using ::ranges::all_of;
using ::ranges::any_of;
using ::ranges::binary_search;
using ::ranges::copy;
using ::ranges::copy_if;
using ::ranges::count;
using ::ranges::count_if;
using ::ranges::equal;
using ::ranges::fill;
using ::ranges::find;
using ::ranges::find_if;
using ::ranges::for_each;
using ::ranges::is_sorted;
using ::ranges::lower_bound;
using ::ranges::max;
using ::ranges::max_element;
using ::ranges::min;
using ::ranges::minmax;
using ::ranges::move;
using ::ranges::none_of;
using ::ranges::nth_element;
using ::ranges::replace;
using ::ranges::reverse;
using ::ranges::sort;
using ::ranges::stable_sort;
using ::ranges::transform;
using ::ranges::upper_bound;
}  // namespace std::ranges

#endif

#ifndef __cpp_lib_bit_cast

#include <bit>

namespace std {
template <class To, class From>
constexpr To bit_cast(const From& value) noexcept {
  return __builtin_bit_cast(To, value);
}
}  // namespace std

#endif

// libc++ has no macro for from_chars and to_chars of floating-point numbers.
#if _LIBCPP_VERSION < 200000

#include <fast_float/fast_float.h>

#include <charconv>

namespace std {
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const auto [end, error] = fast_float::from_chars(first, last, value);
  return {end, error};
}
}  // namespace std

#endif

#if _LIBCPP_VERSION < 140000

#include <fmt/format.h>

namespace std {
/// The fewest digits that give the same number. The exponent appears where fmt writes one.
inline to_chars_result to_chars(char* first, char* last, double value) {
  const auto [end, size] = fmt::format_to_n(first, last - first, "{}", value);
  if (size > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
  return {end, errc()};
}
}  // namespace std

#endif
