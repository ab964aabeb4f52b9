#pragma once

namespace clatter {

/// Prefetches the cache line of an object. The code is assembly, because GCC drops the call of a
/// function that contains only __builtin_prefetch.
template <typename T>
inline void prefetch(const T& object) {
#if defined(__x86_64__)
  asm volatile("prefetcht0 %0" : : "m"(object));
#else
  __builtin_prefetch(&object);
#endif
}

}  // namespace clatter
