#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/neighbour.h"
#include "engine/dynamics/packed_image.h"
#include "engine/physics/pair_contact.h"

namespace clatter {

/// Doubles per particle in the array that contact kernels read: a cache line.
inline constexpr int kRowLength = 8;

/// Possible partners of one particle. A particle is a row of kRowLength doubles: D of position, D
/// of velocity, the time of both, and two words. The first word is not read, the second is a
/// PackedImage: the row's frame and the particle's kind.
template <int D>
struct Candidates {
  static constexpr int kCapacity = D == 2 ? 16 : 32;

  /// kMargin further elements may be read and written.
  static constexpr int kMargin = 4;
  Neighbour neighbours[kCapacity + kMargin];
  int size = 0;
};

/// The periodic images of candidates.
template <int D>
struct ImageFrame {
  const double* box;           ///< [D] edge lengths
  bool sheared = false;        ///< see Domain
  double offset = 0.0;         ///< as Domain::offset, at time 0
  double slide = 0.0;          ///< as Domain::slide
  int boxes_slid = 0;          ///< lengths by which the image above has slid beside its wraps
};

/// The first contact of a particle with its candidates.
struct FirstContact {
  double time;    ///< kNever: none; kTouching: at least one already touches
  int candidate;  ///< candidate of this time; 0 without a contact
  bool unique;    ///< false: others may have the same time or touch too, and each needs a check;
                  ///< see also first_contacts
};

/// Vectors of four numbers. The instruction set of the calling function determines whether they
/// fill one register or two.
namespace lanes {

inline constexpr int kCount = 4;
using Doubles = double __attribute__((vector_size(8 * kCount)));
using Bits = std::int64_t __attribute__((vector_size(8 * kCount)));
using Ints = std::int32_t __attribute__((vector_size(4 * kCount)));

[[gnu::always_inline]] inline Doubles load(const double* from) {
  Doubles numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

[[gnu::always_inline]] inline Doubles broadcast(double number) {
  return Doubles{number, number, number, number};
}

// Transposes the numbers first ... first + 3 of four rows.
[[gnu::always_inline]] inline void transpose(const double* const* row, int first,
                                             Doubles* columns) {
  Doubles in[4];
  for (int i = 0; i < 4; ++i) in[i] = load(row[i] + first);
  const Doubles even_01 = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6);
  const Doubles odd_01 = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7);
  const Doubles even_23 = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6);
  const Doubles odd_23 = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
  columns[0] = __builtin_shufflevector(even_01, even_23, 0, 1, 4, 5);
  columns[1] = __builtin_shufflevector(odd_01, odd_23, 0, 1, 4, 5);
  columns[2] = __builtin_shufflevector(even_01, even_23, 2, 3, 6, 7);
  columns[3] = __builtin_shufflevector(odd_01, odd_23, 2, 3, 6, 7);
}

[[gnu::always_inline]] inline Doubles lesser(const Doubles& a, const Doubles& b) {
  return a < b ? a : b;
}

// The least of four numbers, in every lane.
[[gnu::always_inline]] inline Doubles least(const Doubles& numbers) {
  const Doubles pairs = lesser(numbers, __builtin_shufflevector(numbers, numbers, 2, 3, 0, 1));
  return lesser(pairs, __builtin_shufflevector(pairs, pairs, 1, 0, 3, 2));
}

// The wraps of four neighbours along an axis.
template <int D>
[[gnu::always_inline]] inline Ints wraps_of(const Neighbour* neighbours, int axis) {
  Ints bits;
  std::memcpy(&bits, neighbours, sizeof bits);
  return (bits << bits_above<D>(axis)) >> 30;
}

// The second words of four doubles.
[[gnu::always_inline]] inline Ints second_words(const Doubles& numbers) {
  using Words = std::int32_t __attribute__((vector_size(8 * kCount)));
  const Words words = reinterpret_cast<const Words&>(numbers);
  return __builtin_shufflevector(words, words, 1, 3, 5, 7);
}

// Place of the second word of a row.
template <int D>
inline constexpr int kImage = 2 * D + 1;

// The second word of a row.
template <int D>
[[gnu::always_inline]] inline PackedImage image_word(const double* row) {
  PackedImage word;
  std::memcpy(&word, reinterpret_cast<const char*>(row + kImage<D>) + sizeof word, sizeof word);
  return word;
}

// A particle and its candidates, in groups of four.
template <int D>
struct Groups {
  static constexpr int kMax = Candidates<D>::kCapacity / kCount;
  int count = 0;
  PairApproach<Doubles> approaches[kMax];
  Doubles times[kMax];
  Ints images{};  // with kShifted the bits of all rows' images, otherwise their differences
};

// Distances at contact of a particle and four neighbours, if all particles are alike: a double.
template <int D>
[[gnu::always_inline]] inline double distances_of(double diameter, std::uint32_t, const double*,
                                                  const Neighbour*, const double* const*) {
  return diameter;
}
// The same in a mixture, from the radii of kinds or of all particles.
template <int D>
[[gnu::always_inline]] inline Doubles distances_of(const Radii& radii, std::uint32_t particle,
                                                   const double* own, const Neighbour* neighbours,
                                                   const double* const* rows) {
  if (radii.of_kinds) {
    const auto radius = [&](const double* row) {
      return radii.of_kinds[kind_of(image_word<D>(row))];
    };
    return broadcast(radius(own)) +
           Doubles{radius(rows[0]), radius(rows[1]), radius(rows[2]), radius(rows[3])};
  }
  const auto radius = [&](int lane) {
    return radii.of_particles[particle_of<D>(neighbours[lane])];
  };
  return broadcast(radii.of_particles[particle]) +
         Doubles{radius(0), radius(1), radius(2), radius(3)};
}

// Calculates the approaches of all candidates to a particle, see first_contacts.
template <int D, bool kFalling, bool kShifted, class Sizes>
[[gnu::always_inline]] inline void approach(const double* rows, std::uint32_t particle,
                                            Candidates<D>& candidates, const ImageFrame<D>& frame,
                                            const Sizes& sizes, const double* gravity,
                                            Groups<D>& groups) {
  const double* const own = rows + static_cast<std::size_t>(particle) * kRowLength;
  Doubles r[D], v[D];
  for (int k = 0; k < D; ++k) {
    r[k] = broadcast(own[k]);
    v[k] = broadcast(own[D + k]);
  }
  const Doubles time = broadcast(own[2 * D]);
  const PackedImage word = image_word<D>(own);
  const Ints own_image{word, word, word, word};
  groups.images = own_image & (kShifted ? kImageMask : kFarImage);
  for (int i = 0; i < Candidates<D>::kMargin; ++i)
    candidates.neighbours[candidates.size + i] = particle;
  for (int i = 0; i == 0 || i < candidates.size; i += kCount) {
    const double* row[kCount];
    for (int lane = 0; lane < kCount; ++lane) {
      row[lane] = rows + static_cast<std::size_t>(particle_of<D>(candidates.neighbours[i + lane])) *
                             kRowLength;
    }
    Doubles columns[kRowLength];
    for (int k = 0; k < kRowLength; k += 4) transpose(row, k, columns + k);
    const Ints image = second_words(columns[kImage<D>]);
    groups.images |= kShifted ? image : image ^ own_image;
    Doubles shift[D], slide{};
    const Doubles* slides = nullptr;
    if constexpr (kShifted) {
      Doubles above{};
      for (int k = 0; k < D; ++k) {
        Ints boxes = image_component<D>(image, k) - image_component<D>(own_image, k) -
                     wraps_of<D>(candidates.neighbours + i, k);
        if (k == 0 && frame.sheared) {
          boxes += frame.boxes_slid * wraps_of<D>(candidates.neighbours + i, 1);
        }
        const Doubles lengths = __builtin_convertvector(boxes, Doubles);
        shift[k] = lengths * frame.box[k];
        if (k == 1) above = lengths;
      }
      if (frame.sheared) {
        shift[0] += above * frame.offset;
        slide = above * frame.slide;
        slides = &slide;
      }
    }
    groups.approaches[groups.count++] = approach_of<D, kFalling>(
        r, v, time, columns, columns + D, columns[2 * D], kShifted ? shift : nullptr,
        distances_of<D>(sizes, particle, own, candidates.neighbours + i, row), gravity, slides);
  }
}

// The first contact; `earliest` has the least time in every lane.
template <int D, bool kShifted>
[[gnu::always_inline]] inline FirstContact first_of(const Groups<D>& groups,
                                                    const Doubles& earliest) {
  Bits shared{}, bit{1, 2, 4, 8};
  for (int group = 0; group < groups.count; ++group, bit <<= kCount) {
    shared |= (groups.times[group] == earliest) & bit;
  }
  const auto sharing =
      static_cast<std::uint64_t>((shared[0] | shared[1]) | (shared[2] | shared[3]));
  const double time = earliest[0];
  const bool never = time == kNever, alone = (sharing & (sharing - 1)) == 0;
  bool unique = (alone | never) & (time != kTouching);
  const Ints pairs =
      groups.images | __builtin_shufflevector(groups.images, groups.images, 2, 3, 0, 1);
  const std::int32_t images = pairs[0] | pairs[1];
  unique &= kShifted ? images >= 0 : (images & kImageMask) == 0;
  return {time, never ? 0 : std::countr_zero(sharing), unique};
}

}  // namespace lanes

/// For each particle, the first pair_contact_time with its candidates. A particle may be its own
/// candidate, without effect. `rows` holds all particles. `sizes` is the diameter of all, a double,
/// or the Radii of a mixture. `gravity` is read only with kFalling. The result has the same bits
/// with any instruction set.
///
/// Without kShifted, no candidate may have a wrap, and all rows must be in the same frame. No row's
/// image may be far. If a row does not fit, `unique` is false and the other results are invalid.
template <int D, bool kFalling, bool kShifted, std::size_t kParticles, class Sizes>
[[gnu::always_inline]] inline std::array<FirstContact, kParticles> first_contacts(
    const double* rows, const std::array<std::uint32_t, kParticles>& particles,
    std::array<Candidates<D>, kParticles>& candidates, const ImageFrame<D>& frame,
    const Sizes& sizes, const double* gravity) {
  using namespace lanes;
  Groups<D> groups[kParticles];
  for (std::size_t k = 0; k < kParticles; ++k) {
    approach<D, kFalling, kShifted>(rows, particles[k], candidates[k], frame, sizes, gravity,
                                    groups[k]);
  }
  // A separate loop, so that the roots and quotients of all groups overlap in the pipeline.
  Doubles earliest[kParticles];
  for (std::size_t k = 0; k < kParticles; ++k) {
    earliest[k] = broadcast(kNever);
    for (int group = 0; group < groups[k].count; ++group) {
      groups[k].times[group] = pair_contact_time(groups[k].approaches[group]);
      earliest[k] = lesser(groups[k].times[group], earliest[k]);
    }
  }
  std::array<FirstContact, kParticles> first;
  for (std::size_t k = 0; k < kParticles; ++k) {
    first[k] = first_of<D, kShifted>(groups[k], least(earliest[k]));
  }
  return first;
}

}  // namespace clatter
