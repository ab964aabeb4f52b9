#include "tests/engine/support/allocations.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

static std::atomic<std::size_t> allocated = 0;
static std::atomic<std::size_t> in_use = 0;
static std::atomic<std::size_t> most_in_use = 0;

static void count(std::size_t asked, std::size_t held) {
  allocated += asked;
  const std::size_t now = in_use += held;
  std::size_t most = most_in_use;
  while (most < now && !most_in_use.compare_exchange_weak(most, now)) {
  }
}

static void* counted(void* memory, std::size_t bytes) {
  if (!memory) throw std::bad_alloc();
  count(bytes, malloc_usable_size(memory));
  return memory;
}

static void give_back(void* memory) {
  in_use -= malloc_usable_size(memory);
  std::free(memory);
}

void* operator new(std::size_t bytes) {
  return counted(std::malloc(bytes), bytes);
}

// The usable size of aligned memory includes the address space between its end and the next
// alignment, up to 2 MB by chance, which never becomes resident. So the requested bytes count.
// Their number lies before the memory.
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto offset = static_cast<std::size_t>(alignment);
  void* block = nullptr;
  if (posix_memalign(&block, offset, offset + bytes) != 0) throw std::bad_alloc();
  void* const memory = static_cast<char*>(block) + offset;
  static_cast<std::size_t*>(memory)[-1] = bytes;
  count(bytes, bytes);
  return memory;
}

// std::stable_sort allocates its buffer here. The usual operator delete frees it.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  void* memory = std::malloc(bytes);
  if (memory) count(bytes, malloc_usable_size(memory));
  return memory;
}

void operator delete(void* memory) noexcept {
  give_back(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}

static void give_back_aligned(void* memory, std::align_val_t alignment) {
  if (!memory) return;
  in_use -= static_cast<std::size_t*>(memory)[-1];
  std::free(static_cast<char*>(memory) - static_cast<std::size_t>(alignment));
}

void operator delete(void* memory, std::align_val_t alignment) noexcept {
  give_back_aligned(memory, alignment);
}

void operator delete(void* memory, std::size_t, std::align_val_t alignment) noexcept {
  give_back_aligned(memory, alignment);
}

std::size_t clatter::testing::allocated_bytes() {
  return allocated;
}

std::size_t clatter::testing::bytes_in_use() {
  return in_use;
}

std::size_t clatter::testing::most_bytes_in_use() {
  return most_in_use;
}

void clatter::testing::restart_most_bytes_in_use() {
  most_in_use = in_use.load();
}
