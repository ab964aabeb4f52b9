#pragma once

// No Eigen here, see encounter.h.

#include <cstdint>

namespace clatter {

/// Doubles from one disk to the next in an array that contact kernels read: whole cache lines.
template <int D>
inline constexpr int kRowLength = (3 * D + 2 + 7) / 8 * 8;

/// Disks that one disk may meet. A disk is a row of kRowLength doubles: D of position, D of
/// velocity, the time of both, one that is not read, and D whole box lengths by which the row's
/// frame lies off the box.
template <int D>
struct Candidates {
  static constexpr int kCapacity = 16;

  /// Numbers of the rows, and behind the last of them room for kMargin more to be read and written.
  static constexpr int kMargin = 3;
  std::uint32_t disks[kCapacity + kMargin];
  double wraps[D][kCapacity + kMargin];  ///< box lengths to subtract from each one's; if `wrapped`
  int size = 0;
  bool wrapped = false;
};

/// Which of its candidates a disk touches first.
struct FirstContact {
  double time;      ///< kNever: none, kTouching: at least one touches already
  int candidate;    ///< whose time this is; 0 where there is none
  bool told_apart;  ///< false: others may share the time, or touch too, and must be asked
};

/// The first encounter_time of the disk in row `self` with the candidates. The disk itself may be
/// among them: it never meets itself. `rows` holds all disks, `box` are its D edge lengths.
template <int D>
using FirstContactKernel = FirstContact(const double* rows, std::uint32_t self,
                                        Candidates<D>& candidates, const double* box,
                                        double diameter, const double* gravity);

/// The kernel with vectors as wide as the processor has; the same bits on any. `gravity` is not
/// read unless disks are falling.
template <int D>
FirstContactKernel<D>* first_contact_kernel(bool falling);

}  // namespace clatter
