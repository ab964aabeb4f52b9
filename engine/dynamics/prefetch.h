#pragma once

#include <cstddef>

namespace clatter {

/// Prefetches the cache lines of an object. The code is assembly, because GCC drops the call of a
/// function that contains only __builtin_prefetch.
template <typename T>
inline void prefetch(const T& object) {
  constexpr std::size_t kLine = 64;
  const char* const bytes = reinterpret_cast<const char*>(&object);
  for (std::size_t at = 0; at < sizeof object; at += kLine) {
#if defined(__x86_64__)
    asm volatile("prefetcht0 %0" : : "m"(bytes[at]));
#else
    __builtin_prefetch(bytes + at);
#endif
  }
}

}  // namespace clatter
