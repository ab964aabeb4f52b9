#pragma once

// No Eigen here, see encounter.h.

namespace clatter {

/// Flights that one disk may meet, component by component.
template <int D>
struct Candidates {
  static constexpr int kCapacity = 48;

  alignas(64) double r[D][kCapacity];
  alignas(64) double v[D][kCapacity];
  alignas(64) double time[kCapacity];
  alignas(64) double shift[D][kCapacity];  ///< added to the one disk's r minus the candidate's
  alignas(64) double contact[kCapacity];   ///< result: encounter_time with each
};

/// Fills the first `size` of candidates.contact for the flight (r, v, time), with the widest
/// vectors that the processor has, and returns the earliest, kNever or kTouching included; the bits
/// are those of encounter_time on any. `gravity` is null where there is none.
template <int D>
double contact_times(const double* r, const double* v, double time, double diameter,
                     const double* gravity, Candidates<D>& candidates, int size);

}  // namespace clatter
