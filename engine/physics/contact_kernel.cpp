// What takes or returns vectors is inlined, so how they would be passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

#include "engine/physics/contact_kernel.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include "engine/physics/encounter.h"

namespace clatter {

namespace {

// Four numbers, in one register or in two, as the instruction set has it.
constexpr int kLanes = 4;
using Lanes = double __attribute__((vector_size(8 * kLanes)));
using Bits = std::int64_t __attribute__((vector_size(8 * kLanes)));

[[gnu::always_inline]] inline Lanes load(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

[[gnu::always_inline]] inline Lanes broadcast(double number) {
  return Lanes{number, number, number, number};
}

// Numbers first ... first + 3 of four rows, number by number.
[[gnu::always_inline]] inline void transpose(const double* const* row, int first, Lanes* columns) {
  Lanes in[4];
  for (int i = 0; i < 4; ++i) in[i] = load(row[i] + first);
  const Lanes even_01 = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6);
  const Lanes odd_01 = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7);
  const Lanes even_23 = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6);
  const Lanes odd_23 = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
  columns[0] = __builtin_shufflevector(even_01, even_23, 0, 1, 4, 5);
  columns[1] = __builtin_shufflevector(odd_01, odd_23, 0, 1, 4, 5);
  columns[2] = __builtin_shufflevector(even_01, even_23, 2, 3, 6, 7);
  columns[3] = __builtin_shufflevector(odd_01, odd_23, 2, 3, 6, 7);
}

[[gnu::always_inline]] inline Lanes lesser(const Lanes& a, const Lanes& b) {
  return a < b ? a : b;
}

// The least of four numbers, in every lane.
[[gnu::always_inline]] inline Lanes least(const Lanes& lanes) {
  const Lanes pairs = lesser(lanes, __builtin_shufflevector(lanes, lanes, 2, 3, 0, 1));
  return lesser(pairs, __builtin_shufflevector(pairs, pairs, 1, 0, 3, 2));
}

// Who of several groups of four touches at the least of all their times.
[[gnu::always_inline]] inline FirstContact first_of(const Lanes* times, int groups,
                                                    const Lanes& least_time) {
  Bits shared{}, bit{1, 2, 4, 8};
  for (int group = 0; group < groups; ++group, bit <<= kLanes) {
    shared |= (times[group] == least_time) & bit;
  }
  const auto sharing =
      static_cast<std::uint64_t>((shared[0] | shared[1]) | (shared[2] | shared[3]));
  const double time = least_time[0];
  const bool never = time == kNever, alone = (sharing & (sharing - 1)) == 0;
  return {time, never ? 0 : std::countr_zero(sharing), (alone || never) && time != kTouching};
}

template <int D, bool kFalling>
[[gnu::always_inline]] inline FirstContact loop(const double* rows, std::uint32_t self,
                                                Candidates<D>& candidates, const double* box,
                                                double diameter, const double* gravity) {
  constexpr int kColumns = (3 * D + 2 + 3) / 4 * 4;
  constexpr int kRow = kRowLength<D>;
  const double* const own = rows + static_cast<std::size_t>(self) * kRow;
  Lanes r[D], v[D], image[D];
  for (int k = 0; k < D; ++k) {
    r[k] = broadcast(own[k]);
    v[k] = broadcast(own[D + k]);
    image[k] = broadcast(own[2 * D + 2 + k]);
  }
  const Lanes time = broadcast(own[2 * D]);
  for (int i = 0; i < Candidates<D>::kMargin; ++i) candidates.disks[candidates.size + i] = self;

  Lanes times[Candidates<D>::kCapacity / kLanes];
  Lanes earliest = broadcast(kNever);
  int groups = 0;
  for (int i = 0; i < candidates.size; i += kLanes) {
    const double* row[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      row[lane] = rows + static_cast<std::size_t>(candidates.disks[i + lane]) * kRow;
    }
    Lanes columns[kColumns];
    for (int k = 0; k < kColumns; k += 4) transpose(row, k, columns + k);
    Lanes shift[D];
    for (int k = 0; k < D; ++k) {
      shift[k] = columns[2 * D + 2 + k] - image[k];
      if (candidates.wrapped) shift[k] -= load(&candidates.wraps[k][i]);
      shift[k] *= box[k];
    }
    const Lanes contact = encounter_time<D, kFalling>(r, v, time, columns, columns + D,
                                                      columns[2 * D], shift, diameter, gravity);
    times[groups++] = contact;
    earliest = lesser(contact, earliest);
  }
  return first_of(times, groups, least(earliest));
}

#if defined(__x86_64__)
template <int D, bool kFalling>
[[gnu::target("avx2")]] FirstContact loop_avx2(const double* rows, std::uint32_t self,
                                               Candidates<D>& candidates, const double* box,
                                               double diameter, const double* gravity) {
  return loop<D, kFalling>(rows, self, candidates, box, diameter, gravity);
}
#endif

template <int D, bool kFalling>
FirstContact loop_baseline(const double* rows, std::uint32_t self, Candidates<D>& candidates,
                           const double* box, double diameter, const double* gravity) {
  return loop<D, kFalling>(rows, self, candidates, box, diameter, gravity);
}

template <int D, bool kFalling>
auto widest_loop() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return &loop_avx2<D, kFalling>;
#endif
  return &loop_baseline<D, kFalling>;
}

}  // namespace

template <int D>
FirstContactKernel<D>* first_contact_kernel(bool falling) {
  return falling ? widest_loop<D, true>() : widest_loop<D, false>();
}

template FirstContactKernel<2>* first_contact_kernel<2>(bool);

}  // namespace clatter
