#include "tests/engine/support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

static std::atomic<std::size_t> allocated = 0;

static void* counted(void* memory, std::size_t bytes) {
  if (!memory) throw std::bad_alloc();
  allocated += bytes;
  return memory;
}

void* operator new(std::size_t bytes) {
  return counted(std::malloc(bytes), bytes);
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  void* memory = nullptr;
  const int error = posix_memalign(&memory, static_cast<std::size_t>(alignment), bytes);
  return counted(error == 0 ? memory : nullptr, bytes);
}

// std::stable_sort allocates its buffer here. The usual operator delete frees it.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  void* memory = std::malloc(bytes);
  if (memory) allocated += bytes;
  return memory;
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

std::size_t clatter::testing::allocated_bytes() {
  return allocated;
}
