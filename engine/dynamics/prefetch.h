#pragma once

namespace clatter {

/// Asks for the cache line that holds an object. In assembly, because GCC takes a function that
/// holds nothing but __builtin_prefetch for one without effect and drops the call.
template <typename T>
inline void prefetch(const T& object) {
#if defined(__x86_64__)
  asm volatile("prefetcht0 %0" : : "m"(object));
#else
  __builtin_prefetch(&object);
#endif
}

}  // namespace clatter
