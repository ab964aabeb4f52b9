#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "engine/system/platform.h"

namespace clatter {

/// Allocates large arrays on huge pages if the system has them. Particles are visited in random
/// order. With small pages most visits at N >= 10^5 would be TLB misses as well as cache misses.
template <typename T>
struct LargeArrayAllocator {
  using value_type = T;

  LargeArrayAllocator() = default;
  template <typename U>
  LargeArrayAllocator(const LargeArrayAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* const memory = ::operator new(bytes, alignment(bytes));
    if (bytes >= kHugePage) prefer_huge_pages(memory, bytes);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    ::operator delete(memory, alignment(bytes));
  }
  friend bool operator==(LargeArrayAllocator, LargeArrayAllocator) { return true; }

 private:
  static constexpr std::size_t kHugePage = std::size_t{1} << 21;
  static std::align_val_t alignment(std::size_t bytes) {
    return std::align_val_t{bytes >= kHugePage ? kHugePage : std::size_t{64}};
  }
};

/// An array that may be large and is visited in random order.
template <typename T>
using LargeArray = std::vector<T, LargeArrayAllocator<T>>;

/// Appends an element to an array of unknown final size, and returns its index. The memory grows by
/// an eighth, which wastes less than doubling.
template <typename T>
std::uint32_t append_sparingly(LargeArray<T>& array) {
  if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / 8 + 16);
  array.emplace_back();
  return static_cast<std::uint32_t>(array.size() - 1);
}

}  // namespace clatter
