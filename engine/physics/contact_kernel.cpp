#include "engine/physics/contact_kernel.h"

#include "engine/physics/encounter.h"

namespace clatter {

// The loop runs over whole vectors: what lies beyond `size` is left from earlier and not looked at.
template <int D, bool kFalling>
[[gnu::always_inline]] static inline double loop(const double* r, const double* v, double time,
                                                 double diameter, const double* gravity,
                                                 Candidates<D>& candidates, int size) {
  const int rounded_up = (size + 7) & ~7;
  for (int i = 0; i < rounded_up; ++i) {
    double r_i[D], v_i[D], shift_i[D];
    for (int k = 0; k < D; ++k) {
      r_i[k] = candidates.r[k][i];
      v_i[k] = candidates.v[k][i];
      shift_i[k] = candidates.shift[k][i];
    }
    candidates.contact[i] = encounter_time<D, kFalling>(r, v, time, r_i, v_i, candidates.time[i],
                                                        shift_i, diameter, gravity);
  }
  double first = kNever;
  for (int i = 0; i < size; ++i) {
    first = candidates.contact[i] < first ? candidates.contact[i] : first;
  }
  return first;
}

#if defined(__x86_64__)
template <int D, bool kFalling>
[[gnu::target("avx512f,avx512vl")]] static double loop_avx512(const double* r, const double* v,
                                                              double time, double diameter,
                                                              const double* gravity,
                                                              Candidates<D>& candidates, int size) {
  return loop<D, kFalling>(r, v, time, diameter, gravity, candidates, size);
}

template <int D, bool kFalling>
[[gnu::target("avx2")]] static double loop_avx2(const double* r, const double* v, double time,
                                                double diameter, const double* gravity,
                                                Candidates<D>& candidates, int size) {
  return loop<D, kFalling>(r, v, time, diameter, gravity, candidates, size);
}
#endif

template <int D, bool kFalling>
static double loop_baseline(const double* r, const double* v, double time, double diameter,
                            const double* gravity, Candidates<D>& candidates, int size) {
  return loop<D, kFalling>(r, v, time, diameter, gravity, candidates, size);
}

template <int D, bool kFalling>
static auto widest_loop() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"))
    return &loop_avx512<D, kFalling>;
  if (__builtin_cpu_supports("avx2")) return &loop_avx2<D, kFalling>;
#endif
  return &loop_baseline<D, kFalling>;
}

template <int D>
double contact_times(const double* r, const double* v, double time, double diameter,
                     const double* gravity, Candidates<D>& candidates, int size) {
  static const struct {
    decltype(widest_loop<D, false>()) straight = widest_loop<D, false>();
    decltype(widest_loop<D, true>()) falling = widest_loop<D, true>();
  } loops;
  const auto loop = gravity ? loops.falling : loops.straight;
  return loop(r, v, time, diameter, gravity, candidates, size);
}

template double contact_times<2>(const double*, const double*, double, double, const double*,
                                 Candidates<2>&, int);

}  // namespace clatter
