// Precedes every file of the copy that tests/mutate builds.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>

#include <cstdlib>
#include <type_traits>
#include <utility>

/// The chosen mutant of this process, and the reached ones.
struct Mutants {
  static constexpr int kMost = 1 << 16;

  int chosen;              ///< number in the variable MUTANT; 0: none
  unsigned char* reached;  ///< [kMost] 1: was reached; the file MUTANTS_REACHED, of kMost bytes

  Mutants() {
    const char* number = std::getenv("MUTANT");
    chosen = number ? std::atoi(number) : 0;
    const char* path = std::getenv("MUTANTS_REACHED");
    const int file = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    reached = static_cast<unsigned char*>(mmap(nullptr, kMost, PROT_READ | PROT_WRITE,
                                               file < 0 ? MAP_PRIVATE | MAP_ANONYMOUS : MAP_SHARED,
                                               file, 0));
  }
};

/// Whether the mutant of this number is chosen. Several processes may share the file of reached
/// ones.
inline bool mutant(int number) {
  static const Mutants mutants;
  mutants.reached[number] = 1;
  return mutants.chosen == number;
}

/// An expression as the alternative of one of type A. Numbers get type A, so that a conditional of
/// both keeps the type of the original.
template <class A, class B>
constexpr decltype(auto) like(B&& other) {
  using To = std::remove_cvref_t<A>;
  using From = std::remove_cvref_t<B>;
  if constexpr (std::is_arithmetic_v<To> && std::is_arithmetic_v<From> &&
                !std::is_same_v<To, From>) {
    return static_cast<To>(other);
  } else {
    return std::forward<B>(other);
  }
}
